#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fathom/image/depth_map.h"

namespace fathom {

enum class MapFormat { exr, pfm, png, npy };

/// The format that a path's suffix names (any case); nullopt if none.
std::optional<MapFormat> map_format_of(const std::filesystem::path& path);

/// EXR compressions that lose nothing.
enum class Compression { none, rle, zips, zip, piz };

struct WriteOptions {
  Compression compression = Compression::zip;
  /// Threads to compress with; 0: all.
  int threads = 0;
  /// The channel that PFM, PNG and NPY hold; where empty, the map's only channel.
  std::string channel;
};

/// Writes a map to `path` itself, in place; writing beside and renaming is the caller's.
///   EXR   every channel, all attributes (interface.md, EXR).
///   PFM   one binary32 channel, bottom row first, little endian, scale −1.
///   PNG   one channel of 16-bit codes, big endian as PNG has it, the scale as text chunk
///         `fathom:scale`, attributes as text chunks; identifiers up to 65534 as well.
///   NPY   one channel, C order, shape (height, width), version 1.0.
/// Fails    OutputError: "PATH: why" (disk full, not writable), or where the format cannot hold
///          what the map has. UsageError: the channel is missing or ambiguous.
void write_map(const DepthMap& map, const std::filesystem::path& path, MapFormat format,
               const WriteOptions& options = {});

/// Reads a map back, recognised by content. EXR files of other programs too: HALF channels are
/// widened to binary32; a layered name is kept in full. Nothing is allocated for a size that the
/// file cannot fill.
/// Fails    InputError: "PATH: what is wrong and what was expected".
DepthMap read_map(const std::filesystem::path& path);

}  // namespace fathom
