#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/files/file_bytes.h"
#include "fathom/image/depth_map.h"

/// Single arrays of NPY, which are also the members of an NPZ. `name` is for messages. What reads
/// fails with InputError.
namespace fathom::image {

/// The preamble and the header of an array of a type, "<f8", and a shape, "3, 4"; its values, which
/// follow, begin at a multiple of 64 bytes.
files::Bytes npy_header(const std::string& type, const std::string& shape);

/// The header of an array.
struct NpyHeader {
  /// "<f8"
  std::string type;
  /// Whether the first dimension varies fastest.
  bool fortran_order = false;
  std::vector<std::uint32_t> shape;
  /// The bytes before the values.
  std::size_t size = 0;
};
/// The header of a file, from its first bytes.
NpyHeader npy_header_of(files::ByteView bytes, const std::string& name);

struct ImageSize {
  std::uint32_t width = 0, height = 0;
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// The channels that are the parts of a vector channel, in their order: N.X, N.Y and N.Z for "N",
/// or name.0, name.1, …, two to four channels of one type; empty if the map has no such channels.
std::vector<const ImageChannel*> parts_of(const DepthMap& map, const std::string& name);

/// An array of shape (height, width) or, for several channels of one type, (height, width, parts).
files::Bytes npy_of_channels(const ImageSize& size,
                             const std::vector<const ImageChannel*>& channels);
/// The channel of this name that an array holds, or its parts (names as in parts_of()).
std::vector<ImageChannel> channels_of_npy(files::ByteView bytes, const std::string& channel,
                                          ImageSize& size, const std::string& name);
/// Whether an array has the type and the dimensions of a channel.
bool is_image_array(files::ByteView bytes, const std::string& name);

/// A single text, an array without dimensions: numpy's bytes.
files::Bytes npy_of_text(const std::string& text);
std::string text_of_array(files::ByteView bytes, const std::string& name);

}  // namespace fathom::image
