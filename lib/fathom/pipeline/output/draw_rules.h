#pragma once

#include <vector>

#include "fathom/pipeline/options.h"
#include "fathom/scene/scene.h"

namespace fathom::pipeline {

/// How the fragments of one object meet the frame buffer: the options, and what the scene says of
/// the object.
struct DrawRules {
  std::optional<Comparison> depth_test;  ///< as in DrawState
  bool depth_write = true;
  bool colour_write = true;
  std::optional<StencilState> stencil;
  std::optional<double> alpha;
  /// Fragments that fail the depth test are blended too, and count as passing for the stencil
  /// value, as where OpenGL's depth test is off; what they leave of their depth is nothing.
  bool blends_failed = false;
  DepthBias offset;
};

/// For each object of the scene.
/// Fails    InputError where an object asks for what these options cannot do: a polygon offset of
///          depths that fragments compute themselves, a state under area sampling, which has no
///          depth buffer, or one with more than an opacity under the painter's algorithm.
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

/// What becomes of a stencil value: the action, in the bits of the write mask alone.
std::uint8_t after(StencilAction action, const StencilState& state, std::uint8_t value);

}  // namespace fathom::pipeline
