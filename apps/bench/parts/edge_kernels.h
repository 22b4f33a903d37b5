#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/exact_picture.h"

namespace fathom::bench {

/// The part of a block of 8 × 8 pixels, aligned to the image, that lies in the box of a triangle.
struct PixelBlock {
  static constexpr std::int32_t side = 8;
  /// By column and row of the box; both ends belong to it.
  std::int32_t left, right, top, bottom;
  /// Whether an edge function is too small at all pixels of the block, and whether no edge function
  /// is too small at any pixel: the greatest and the least values are at the corners. Exact.
  bool is_outside = false, is_inside = true;

  [[nodiscard]] std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(right - left + 1) *
           static_cast<std::uint64_t>(bottom - top + 1);
  }
};

/// The block that begins at a column and row of the image, which are multiples of 8.
inline PixelBlock look_at_block(const EdgeSetup& s, std::int32_t column, std::int32_t row) {
  constexpr std::int32_t side = PixelBlock::side;
  PixelBlock b{std::max(column - s.first_column, 0),
               std::min(column + side - s.first_column, s.columns) - 1,
               std::max(row - s.first_row, 0), std::min(row + side - s.first_row, s.rows) - 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool grows_right = s.right[k] > 0, grows_down = s.down[k] > 0;
    const std::int64_t greatest = s.start[k] + s.right[k] * (grows_right ? b.right : b.left) +
                                  s.down[k] * (grows_down ? b.bottom : b.top);
    const std::int64_t least = s.start[k] + s.right[k] * (grows_right ? b.left : b.right) +
                               s.down[k] * (grows_down ? b.top : b.bottom);
    b.is_outside |= greatest < s.least[k];
    b.is_inside &= least >= s.least[k];
  }
  return b;
}

struct BlockCounts {
  std::uint64_t tested = 0, outside = 0, inside = 0;
  /// In blocks that are neither outside nor inside.
  std::uint64_t pixels_tested = 0;

  void add(const PixelBlock& block) {
    ++tested;
    outside += block.is_outside;
    inside += block.is_inside;
    if (!block.is_outside && !block.is_inside) pixels_tested += block.pixels();
  }
};

/// visit(block) for the blocks that the box of a triangle meets.
template <class Visit>
void for_each_block(const EdgeSetup& s, const Visit& visit) {
  constexpr std::int32_t side = PixelBlock::side;
  for (std::int32_t row = s.first_row / side * side; row < s.first_row + s.rows; row += side)
    for (std::int32_t column = s.first_column / side * side; column < s.first_column + s.columns;
         column += side)
      visit(look_at_block(s, column, row));
}

// The textbook's rasterizer, three edge functions over a bounding box, with several pixels of a row
// at once. All of it is compiled for each kind of vector instructions, and runs with the best kind
// that the processor has. More lanes than a vector has take several vectors.

/// A number for each pixel, with room at the right for the rest of a vector.
template <class Number>
struct PaddedImage {
  PaddedImage(std::uint32_t its_width, std::uint32_t its_height, Number value)
      : width(its_width),
        height(its_height),
        stride(its_width + most_lanes),
        numbers(stride * its_height, value) {}
  static constexpr std::size_t most_lanes = 16;

  [[nodiscard]] Number* row(std::size_t y) { return numbers.data() + y * stride; }
  /// Without the padding at the right.
  [[nodiscard]] Picture picture() const {
    Picture result;
    result.reserve(std::size_t{width} * height);
    for (std::size_t y = 0; y < height; ++y) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(y * stride);
      result.insert(result.end(), begin, begin + width);
    }
    return result;
  }

  std::uint32_t width, height;
  std::size_t stride;
  std::vector<Number> numbers;
};

/// Lanes of `Number` in a vector of this processor: 16 of binary32 and 8 of binary64 with AVX-512.
template <class Number>
int lanes_of_a_vector();

/// Adds each triangle's weight to the pixels that it covers, testing all pixels of its box, `lanes`
/// at once: 2, 4, 8 or 16.
/// Exact    over binary64; over binary32 only if fits_binary32().
template <class Number>
void add_boxes(std::span<const EdgeSetup> setups, int lanes, PaddedImage<Number>& layers);

/// add_blocks_one_by_one(), with eight pixels of a row at once.
BlockCounts add_blocks(std::span<const EdgeSetup> setups, PaddedImage<double>& layers);

/// A part of an image with its z-buffer, in binary64.
struct DepthImage {
  DepthImage(std::uint32_t width, std::uint32_t height)
      : depths(width, height, 1), numbers(width, height, 0) {}
  /// Clears the image and moves it to another place.
  void clear(std::uint32_t column, std::uint32_t row);

  std::uint32_t first_column = 0, first_row = 0;
  PaddedImage<double> depths;
  /// Of the triangle plus one; 0: none.
  PaddedImage<double> numbers;
};
/// Draws some of the triangles, eight pixels at once, where they are nearer than earlier ones.
void draw_nearest(std::span<const EdgeSetup> setups, std::span<const std::uint32_t> which,
                  DepthImage& image);

/// Draws all triangles in the whole image.
void draw_nearest(std::span<const EdgeSetup> setups, DepthImage& image);

// The textbook's rasterizer: three edge functions at one pixel after the other. It is compiled
// without vector instructions, as the baseline for vectors.

/// Adds each triangle's weight to the pixels that it covers, testing all pixels of its box, with
/// edge functions over `Number`: float (added to layers of float), double, or integers of 64 bits.
/// Exact    over double and integers; over float only if fits_binary32().
template <class Number, class Layer>
void add_boxes_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<Layer>& layers);

/// The same over binary64, but first with blocks of 8 × 8 pixels. Blocks outside an edge are left
/// out, and in blocks inside all three edges no pixel is tested.
BlockCounts add_blocks_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<double>& layers);

struct TileCounts {
  std::uint64_t tiles = 0;
  /// Pairs of a triangle and a tile that its box meets.
  std::uint64_t pairs = 0;
  /// Tiles of the thread that drew most.
  std::uint64_t most_of_a_thread = 0;
};

/// The nearest triangles of an image, tile by tile: triangles are sorted into square tiles of
/// `side` pixels by their boxes, and each thread draws tiles into a small z-buffer of its own,
/// which it copies to the image.
TileCounts draw_in_tiles(std::span<const EdgeSetup> setups, std::uint32_t side, int threads,
                         DepthImage& image);

}  // namespace fathom::bench
