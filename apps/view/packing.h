#pragma once

#include <cstdint>
#include <span>
#include <string>

/// Values of maps as text in a page, without loss. web/planes.js unpacks them.
namespace fathom::view {

/// Every `step`-th pixel of an image from (x, y) on, in `columns` × `rows`.
struct TilePlace {
  std::uint32_t x = 0, y = 0;
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t step = 1;
};

/// The values of a tile: base64 of the zlib format of
///   a byte     what a value is predicted from: 0, its left neighbour; 1, left + upper − upper
///              left; 2, the other two parts of the unit vector
///   the bytes  of value − prediction (modulo 2^bits, zigzag: 0, −1, 1, −2, … become 0, 1, 2, 3,
///              …), first the lowest byte of all values, row by row, then the next byte
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

/// The X and Y of an image of unit vectors, as binary32.
struct UnitParts {
  std::span<const float> x, y;
};

/// The same of binary32 numbers: the Z of unit vectors with these parts, or any other. A prediction
/// by the other parts is the left neighbour if it has the same X and Y, and else √(1 − X² − Y²),
/// computed in binary64 and rounded to binary32, with the sign of the left neighbour.
std::string packed_third(std::span<const std::uint32_t> plane, const UnitParts& parts,
                         std::uint32_t width, const TilePlace& tile);

/// Words one after another, as a tile of one row.
inline std::string packed(std::span<const std::uint32_t> words) {
  const auto count = static_cast<std::uint32_t>(words.size());
  return packed(words, count, {.columns = count, .rows = 1});
}

/// A script element of this id that holds such a text.
inline std::string script_text(const std::string& id, const std::string& text) {
  return "<script type=\"text/plain\" id=\"" + id + "\">" + text + "</script>\n";
}

}  // namespace fathom::view
