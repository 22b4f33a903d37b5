#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fathom/files/file_bytes.h"
#include "fathom/image/depth_map.h"

/// PNG files of any kind: maps, normals, masks and pictures.
namespace fathom::image {

enum class PngColour { grey, rgb };

/// A PNG to be written: rows of bytes as PNG has them, without a filter.
struct PngPicture {
  std::uint32_t width = 0, height = 0;
  int bit_depth = 8;
  PngColour colour = PngColour::rgb;
  std::vector<std::byte> pixels;
  std::vector<std::pair<std::string, std::string>> texts;
};

/// The bytes of the file; `name` is its name for messages. The same picture gives the same bytes.
/// Fails    OutputError if libpng refuses it.
files::Bytes encode(PngPicture& picture, const std::string& name);

/// A mask as one 8-bit grey channel, 255 where it is not 0.
/// Fails    InputError as encode_mask().
PngPicture picture_of_mask(std::span<const std::uint8_t> mask, std::uint32_t width,
                           std::uint32_t height);

/// Appends the texts of a map and the names of its objects, by which read_map() reads them.
/// Fails    OutputError if a text does not fit PNG.
void add_texts_of_map(PngPicture& picture, const DepthMap& map, const std::string& name);

}  // namespace fathom::image
