#pragma once

#include <cstdint>

#include "fathom/fast/channels/surface_lanes.h"

// The double-word tier of the channels that binary64 never settles, for several samples at once:
// depth and distance in binary64, and Zlow, the depth minus Z. triangle/double_word_surface.h does
// the same for one sample and gives the proofs.
namespace fathom::fast {

/// DepthForms<WordPair> of a surface: c + b·v + a·u, and a constant. If the depth is known to be
/// the same number everywhere, the forms give it without errors, and one of them is 1.
struct alignas(32) WideDepth {
  WordPair c, b, a, constant;
  double error, constant_error;
  std::array<double, 2> unused{};
};

/// The form of a surface.
WideDepth wide_depth(SurfaceFacts& surface, const ValueFrame& frame);
/// The form of an unknown surface.
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
