#pragma once

#include <cstdint>

#include "fathom/fast/channels/surface_lanes.h"

// The double-word tier of what binary64 never settles, several samples at once: depth and distance
// in binary64, and what Z leaves of the depth. triangle/double_word_surface.h does the same for one
// sample, and says why.
namespace fathom::fast {

/// DepthForms<WordPair> of a surface: c + b·v + a·u, and a constant. Where the depth is known to be
/// the same number everywhere, forms without errors, of which one is 1, that give it.
struct alignas(32) WideDepth {
  WordPair c, b, a, constant;
  double error, constant_error;
  std::array<double, 2> unused{};
};

/// That of a surface.
WideDepth wide_depth(SurfaceFacts& surface, const ValueFrame& frame);
/// That of a surface of which nothing is known.
WideDepth unknown_wide_depth();

/// Null where it is not wanted.
struct WideRows {
  RoundedValues<double>*depth = nullptr, *distance = nullptr;
  RoundedValues<float>* low = nullptr;
};
/// Of the samples of a row.
void round_wide(const SurfaceRow& row, const SurfaceIndices& indices, const WideDepth* depths,
                const triangle::SceneRays& rays, const WideRows& wanted);

}  // namespace fathom::fast
