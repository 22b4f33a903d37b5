#pragma once

#include <cstdint>
#include <span>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/coverage/tile_rows.h"
#include "fathom/fast/setup/setup.h"

namespace fathom::fast {

/// The certain facts about a triangle whose area counts for channel A.
enum class CoverageClass : std::uint8_t {
  nothing,   // no point of it has a depth in the range that counts
  positive,  // certainly Δ > 0; all of it in front of the camera and in the range
  negative,  // certainly Δ < 0; all of it in front of the camera and in the range
  open       // none of these
};

struct CoverageTriangle {
  CoverageClass kind;
  /// Positive or negative, and so large that it pays to look at its pixels one by one.
  bool is_large;
  /// The pixels that it can meet, unless it is open.
  TileBox box;
};

/// Classifies triangles of an object, by their numbers in the scene, in a tile, several at once.
void classify_for_coverage(const ImageObject& object, std::span<const std::uint32_t> numbers,
                           const DepthRange& range, const PixelBox& tile,
                           CoverageTriangle* classes);

}  // namespace fathom::fast
