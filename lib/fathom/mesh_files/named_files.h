#pragma once

#include "fathom/files/input_file.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom::mesh_files {

/// How files are read.
inline files::InputFile::Reading reading_of(const ReadOptions& options) {
  using Reading = files::InputFile::Reading;
  return options.map_large_files ? Reading::mapped_where_large : Reading::copied;
}

}  // namespace fathom::mesh_files
