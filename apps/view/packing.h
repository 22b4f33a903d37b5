#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/view/plane_prediction.h"

/// Values of maps as text in a page, without loss. web/planes.js unpacks them.
namespace fathom::view {

/// Every `step`-th pixel of an image from (x, y) on, in `columns` × `rows`.
struct TilePlace {
  std::uint32_t x = 0, y = 0;
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t step = 1;
};

/// The values of a tile: letters that hold seven bits each, the lowest bits first and xor 0x55, of
/// the zlib format of
///   a byte     what a value is predicted from: 0, its left neighbour; 1, left + upper − upper
///              left; 2, the other two parts of the unit vector; 3, the planes that the pixels
///              show (plane_prediction.h). Plus 4: the tile is a row with one value for each of
///              its Segments
///   the bytes  of value − prediction (modulo 2^bits, zigzag: 0, −1, 1, −2, … become 0, 1, 2, 3,
///              …), first the lowest byte of all values, row by row, then the next byte. Of 3,
///              the pixels on known planes come first, then the other pixels in reverse order
/// The letters NUL, LF, CR and < are U+0080 higher, because HTML changes or interprets them.
/// The first row knows no upper neighbour and the first column no left one: they are predicted from
/// the neighbour that is there, the first value from 0. `plane` holds the words of an image that is
/// `width` pixels wide.
/// Fails    std::bad_alloc.
std::string packed(std::span<const std::uint8_t> plane, std::uint32_t width, const TilePlace& tile);
std::string packed(std::span<const std::uint16_t> plane, std::uint32_t width,
                   const TilePlace& tile);
std::string packed(std::span<const std::uint32_t> plane, std::uint32_t width,
                   const TilePlace& tile);
std::string packed(std::span<const std::uint64_t> plane, std::uint32_t width,
                   const TilePlace& tile);

/// The pixels of a tile by their identifier.
struct Segments {
  /// The first pixel of each identifier, in the order of the pixels.
  std::vector<std::uint32_t> firsts;
  /// Of each pixel the place of its identifier in `firsts`.
  std::vector<std::uint32_t> places;
};
Segments segments_of(std::span<const std::uint32_t> identifiers, std::uint32_t width,
                     const TilePlace& tile);

/// What predicts a part of an image of directions, next to its neighbours.
struct DirectionHints {
  /// The X and Y, if the part is the Z of unit vectors.
  std::span<const float> x, y;
  /// A triangle has one direction; nullptr: the map has no identifiers.
  const Segments* segments = nullptr;
};

/// The same of a part of directions, as the bits of binary32 numbers. A prediction by the other two
/// parts is the left neighbour if it has the same X and Y, and else √(1 − X² − Y²), computed in
/// binary64 and rounded to binary32, with the sign of the left neighbour.
std::string packed_direction(std::span<const std::uint32_t> plane, const DirectionHints& hints,
                             std::uint32_t width, const TilePlace& tile);

/// The same of depths whose planes are known, as the bits of binary32 numbers.
std::string packed_depth(std::span<const std::uint32_t> plane, const PlaneHints& hints,
                         std::uint32_t width, const TilePlace& tile);

/// Words one after another, as a tile of one row.
inline std::string packed(std::span<const std::uint32_t> words) {
  const auto count = static_cast<std::uint32_t>(words.size());
  return packed(words, count, {.columns = count, .rows = 1});
}

/// A script element with this id that contains such a text.
inline std::string script_text(const std::string& id, const std::string& text) {
  return "<script type=\"text/plain\" id=\"" + id + "\">" + text + "</script>\n";
}

}  // namespace fathom::view
