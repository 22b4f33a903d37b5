#include "fathom/pipeline/output/draw_rules.h"

#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/text/printable.h"

namespace fathom::pipeline {
namespace {

void require_possible(const DrawState& state, const Object& object,
                      const PipelineOptions& options) {
  const auto fail = [&](const std::string& why) {
    throw InputError("object " + text::printable(object.name) + ": " + why);
  };
  if (state.polygon_offset && is_per_fragment(options.depth_format.mapping))
    fail("a polygon offset does not reach the depths of mapping " +
         std::string(name_of(options.depth_format.mapping)) + ", which fragments compute");
  if (options.antialias.method == AntialiasMethod::area && !is_default(state))
    fail("its 'draw' is for a depth buffer, which area sampling does not have");
  DrawState rest = state;
  rest.alpha.reset();
  if (options.hidden_surface == HiddenSurface::painter && !is_default(rest))
    fail("its 'draw' is for a depth buffer; the painter's algorithm supports only 'alpha'");
}

DrawRules rules_of(const DrawState& state, const PipelineOptions& options) {
  DrawRules rules;
  rules.depth_test = state.depth_test;
  rules.depth_write = state.depth_write;
  rules.colour_write = state.colour_write;
  rules.stencil = state.stencil;
  rules.offset = options.polygon_offset;
  if (state.polygon_offset)
    rules.offset = {state.polygon_offset->factor, state.polygon_offset->units, 0};
  rules.alpha = state.alpha;
  if (state.alpha || !options.blend_alpha) return rules;
  rules.alpha = options.blend_alpha;
  rules.blends_failed = options.blend_depth == BlendDepth::off;
  rules.depth_write = rules.depth_write && options.blend_depth != BlendDepth::read_only;
  return rules;
}

}  // namespace

std::vector<DrawRules> draw_rules_of(const Scene& scene, const PipelineOptions& options) {
  std::vector<DrawRules> rules;
  rules.reserve(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const DrawState state = draw_state_of(scene, i);
    require_possible(state, scene.objects[i], options);
    rules.push_back(rules_of(state, options));
  }
  return rules;
}

std::uint8_t after(StencilAction action, const StencilState& state, std::uint8_t value) {
  int result = value;
  switch (action) {
    case StencilAction::keep:
      break;
    case StencilAction::zero:
      result = 0;
      break;
    case StencilAction::replace:
      result = state.reference;
      break;
    case StencilAction::increment:
      result = value == 255 ? 255 : value + 1;
      break;
    case StencilAction::increment_wrap:
      result = value + 1;
      break;
    case StencilAction::decrement:
      result = value == 0 ? 0 : value - 1;
      break;
    case StencilAction::decrement_wrap:
      result = value - 1;
      break;
    case StencilAction::invert:
      result = ~value;
      break;
  }
  return static_cast<std::uint8_t>((result & state.write_mask) | (value & ~state.write_mask));
}

}  // namespace fathom::pipeline
