#pragma once

#include <filesystem>
#include <string>

#include "fathom/camera/camera_files.h"
#include "fathom/image/depth_map.h"

/// Tables of directions in files: NPY, NPZ, EXR and CSV (docs/camera-files.md).
namespace fathom {

/// Reads a table of directions for an image of this size; the content decides the format.
///   NPY   height × width × 3, binary32 or binary64
///   NPZ   the same, in the array `directions`
///   EXR   the channels d.X, d.Y and d.Z
///   CSV   a line `x,y,z` for each pixel, row by row; the first line may be a heading
/// `name` is the name of the file in the table's source. The file must lie in the folder `confine`
/// unless that is empty.
/// Fails    InputError "PATH: …": a file that is not regular or lies elsewhere, a file of another
///          form or size, and an infinite number.
DirectionTable read_directions(const std::filesystem::path& path, std::uint32_t width,
                               std::uint32_t height, const std::string& name,
                               const std::filesystem::path& confine = {});

/// Reads the tables that a camera file names, relative to the folder of `camera_file`; a table that
/// several cameras share is read once.
DirectionReader directions_beside(const std::filesystem::path& camera_file,
                                  const std::filesystem::path& confine = {});

/// The table as channels: binary64, called directions.0, directions.1 and directions.2, which
/// write_map() writes as one array `directions`, or for EXR binary32, called d.X, d.Y and d.Z.
enum class DirectionChannels { array, exr };
DepthMap map_of_directions(const DirectionTable& table, DirectionChannels channels);

/// The text of a CSV file with the heading `x,y,z`, of numbers with the fewest digits that are read
/// back as the same numbers.
std::string csv_of_directions(const DirectionTable& table);

}  // namespace fathom
