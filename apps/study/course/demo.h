#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study/pipeline_scenes.h"

/// The z-buffer as the textbooks show it: two overlapping triangles, and its numbers.
namespace fathom::studies {

/// The demo of section 6: two overlapping triangles of 320 × 240.
struct Demo {
  RgbImage picture;  ///< the pipeline's, as the counts of fragments and pixels
  std::uint64_t near_fragments = 0, far_fragments = 0, union_of_both = 0, overlap = 0;
  /// Centres inside or on the outline, which is what the source's `>= 0` counts; by the signs of
  /// three integers each.
  std::uint64_t near_closed = 0, far_closed = 0, union_closed = 0;
  std::uint64_t passed_far_first = 0, passed_near_first = 0;
};
Demo demo();
SceneFiles demo_files();

/// Rows of words: what the depth buffer holds, as "0.5", cleared to "1"; colours as W(hite),
/// B(lack) and G(rey).
struct BufferContents {
  std::vector<std::string> depths, colours;
};
/// The z-buffer tables, polygon by polygon, as the pipeline draws them: a black triangle at window
/// depth 0.5, a grey one from 0.25 to 0.95.
struct Tables {
  BufferContents black, black_then_grey, grey_then_black;
};
Tables z_buffer_tables();
/// Both triangles, the black one first.
SceneFiles z_buffer_files();
RgbImage z_buffer_picture();

}  // namespace fathom::studies
