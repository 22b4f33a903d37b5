#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/image/rgb_image.h"

/// The z-buffer as the textbooks show it: two overlapping triangles, and its numbers.
namespace fathom::studies {

/// The demo of section 6: two overlapping triangles of 320 × 240.
struct Demo {
  RgbImage picture;
  std::uint64_t near_fragments = 0, far_fragments = 0, union_of_both = 0, overlap = 0;
  std::uint64_t passed_far_first = 0, passed_near_first = 0;
};
Demo demo();

/// The z-buffer tables: a black triangle at depth 0.5, then a grey one from 0.25 to 0.95. Rows of
/// depths and of colours before and after the grey one.
struct Tables {
  std::vector<std::string> depth_before, colour_before, depth_after, colour_after;
};
Tables z_buffer_tables();

}  // namespace fathom::studies
