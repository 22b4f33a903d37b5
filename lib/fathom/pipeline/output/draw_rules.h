#pragma once

#include <vector>

#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

namespace fathom::pipeline {

/// How the fragments of one object are written to the frame buffer, by the options and by the
/// scene's state of the object.
struct DrawRules {
  std::optional<Comparison> depth_test;  ///< as in DrawState
  bool depth_write = true;
  bool colour_write = true;
  std::optional<StencilState> stencil;
  std::optional<double> alpha;
  /// Fragments that fail the depth test are blended too, and count as passing for the stencil
  /// value, as if OpenGL's depth test were off; they do not write depth.
  bool blends_failed = false;
  DepthBias offset;
};

/// For each object of the scene.
/// Fails    InputError if an object requests a state that these options do not allow: a polygon
///          offset of depths that fragments compute themselves, any state under area sampling,
///          which has no depth buffer, or a state with more than an opacity under the painter's
///          algorithm.
std::vector<DrawRules> draw_rules_of(const Scene& scene, const PipelineOptions& options);

/// Whether `value` compares so with `stored`.
template <class T>
constexpr bool compares(Comparison comparison, T value, T stored) {
  switch (comparison) {
    case Comparison::never:
      return false;
    case Comparison::less:
      return value < stored;
    case Comparison::equal:
      return value == stored;
    case Comparison::less_equal:
      return !(value > stored);
    case Comparison::greater:
      return value > stored;
    case Comparison::not_equal:
      return !(value == stored);
    case Comparison::greater_equal:
      return !(value < stored);
    case Comparison::always:
      break;
  }
  return true;
}

/// A stencil value after an action, which changes only the bits of the write mask.
std::uint8_t after(StencilAction action, const StencilState& state, std::uint8_t value);

}  // namespace fathom::pipeline
