#pragma once

#include <vector>

#include "fathom/mesh_files/read_options.h"
#include "fathom/text/confinement.h"

namespace fathom::mesh_files {

/// The boundaries of every file that another file names.
inline std::vector<text::Boundary> boundaries_of(const ReadOptions& options) {
  if (options.confine.empty()) return {};
  return {{options.confine, "to which files named by other files are confined"}};
}

}  // namespace fathom::mesh_files
