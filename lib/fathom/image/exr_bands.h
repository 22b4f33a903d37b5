#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

/// An EXR that is assembled from bands of rows, each compressed separately, e.g. in different
/// processes: the same bytes as write_map() writes for the whole map.
///
///   beginning, with a table of as many zeros as there are chunks, eight bytes each, at its end
///   for each chunk  the number of its first row, its size, four bytes each, and its bytes
///
/// The entry of a chunk in the table is its offset in the file. Numbers are little-endian.
namespace fathom {

/// How many rows a chunk has, the last one fewer; nullopt for what cannot be written in bands: all
/// but ZIP and ZIPS.
std::optional<std::uint32_t> rows_of_exr_chunk(Compression compression);

/// The bytes before the chunks of a map of this height; `band` has the map's width, channels and
/// header data.
/// Fails    as write_map(); `name` is the file's name for messages.
std::vector<std::byte> exr_beginning(const DepthMap& band, std::uint32_t height,
                                     Compression compression, const std::string& name);

/// The bytes of the chunks of a band, whose first row begins one. The same for any number of
/// threads (0: all).
/// Fails    OutputError if a channel has a type that EXR lacks.
std::vector<std::vector<std::byte>> exr_chunks(const DepthMap& band, Compression compression,
                                               int threads, const std::string& name);

}  // namespace fathom
