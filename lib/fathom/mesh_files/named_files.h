#pragma once

#include <vector>

#include "fathom/files/confinement.h"
#include "fathom/files/input_file.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom::mesh_files {

/// The boundaries of every file that another file names.
inline std::vector<files::Boundary> boundaries_of(const ReadOptions& options) {
  if (options.confine.empty()) return {};
  return {{options.confine, "to which files named by other files are confined"}};
}

/// How files are read.
inline files::InputFile::Reading reading_of(const ReadOptions& options) {
  using Reading = files::InputFile::Reading;
  return options.map_large_files ? Reading::mapped_where_large : Reading::copied;
}

}  // namespace fathom::mesh_files
