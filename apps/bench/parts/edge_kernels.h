#pragma once

#include <cstdint>
#include <span>

#include "apps/bench/parts/edge_setup.h"
#include "apps/bench/parts/padded_image.h"
#include "apps/bench/parts/pixel_block.h"

/// The textbook's rasterizer, three edge functions over a bounding box, with several pixels of a
/// row at once. All of it is compiled for each kind of vector instructions, and runs with the best
/// that the processor has; a number of lanes that is more than one vector takes several.
namespace fathom::bench {

/// Lanes of `Number` in a vector of this processor: 16 of binary32 and 8 of binary64 with AVX-512.
template <class Number>
int lanes_of_a_vector();

/// Adds each triangle's weight to the pixels that it covers, testing all pixels of its box, `lanes`
/// at once: 2, 4, 8 or 16.
/// Exact    over binary64; over binary32 where fits_binary32(), and only there.
template <class Number>
void add_boxes(std::span<const EdgeSetup> setups, int lanes, PaddedImage<Number>& layers);

/// add_blocks_one_by_one(), with eight pixels of a row at once.
BlockCounts add_blocks(std::span<const EdgeSetup> setups, PaddedImage<double>& layers);

/// A part of an image with its z-buffer, in binary64.
struct DepthImage {
  DepthImage(std::uint32_t width, std::uint32_t height)
      : depths(width, height, 1), numbers(width, height, 0) {}
  /// Nothing drawn, at another place of the image.
  void clear(std::uint32_t column, std::uint32_t row);

  std::uint32_t first_column = 0, first_row = 0;
  PaddedImage<double> depths;
  /// Of the triangle plus one; 0: none.
  PaddedImage<double> numbers;
};
/// Draws some of the triangles, eight pixels at once, where they are nearer than what is there.
void draw_nearest(std::span<const EdgeSetup> setups, std::span<const std::uint32_t> which,
                  DepthImage& image);

/// What draw_nearest() does for all triangles of a scene in the whole image.
void draw_nearest(std::span<const EdgeSetup> setups, DepthImage& image);

}  // namespace fathom::bench
