#pragma once

#include <vector>

#include "fathom/mesh_files/read_options.h"
#include "fathom/text/confinement.h"
#include "fathom/text/input_file.h"

namespace fathom::mesh_files {

/// The boundaries of every file that another file names.
inline std::vector<text::Boundary> boundaries_of(const ReadOptions& options) {
  if (options.confine.empty()) return {};
  return {{options.confine, "to which files named by other files are confined"}};
}

/// How files are read.
inline text::InputFile::Reading reading_of(const ReadOptions& options) {
  using Reading = text::InputFile::Reading;
  return options.map_large_files ? Reading::mapped_where_large : Reading::copied;
}

}  // namespace fathom::mesh_files
