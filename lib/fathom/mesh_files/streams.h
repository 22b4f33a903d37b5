#pragma once

#include <memory>

#include "fathom/files/random_access_file.h"
#include "fathom/mesh_files/ply/ply_header.h"
#include "fathom/mesh_files/triangle_stream.h"

/// The streams of the two formats; open_triangle_stream() chooses between them.
namespace fathom::mesh_files {

/// `check`: read through the file, and find the bounds.
std::unique_ptr<TriangleStream> open_stl_stream(std::unique_ptr<files::RandomAccessFile> file,
                                                bool check, Warnings& warnings);

/// `header` is the header of the file, which must be binary. Of the options, `segments`,
/// `check_when_opened` and `map_large_files` matter. If neither a check nor segments are requested,
/// a file whose size fits triangles only is not read through.
std::unique_ptr<TriangleStream> open_ply_stream(std::unique_ptr<files::RandomAccessFile> file,
                                                const PlyHeader& header, const ReadOptions& options,
                                                Warnings& warnings);

}  // namespace fathom::mesh_files
