#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <ranges>
#include <string>

#include "entry_points.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/render.h"
#include "fathom/scene/scene.h"

/// One function for each file of bindings. What they bind is for the modules of the package alone,
/// which check arguments, keep units and shapes, and carry the documentation.
namespace fathom::python {

void bind_camera(Module& core);
void bind_scene(Module& core);
void bind_maps(Module& core);
void bind_comparison(Module& core);
void bind_pictures(Module& core);
void bind_render(Module& core);
void bind_questions(Module& core);
void bind_evaluation(Module& core);
void bind_rays(Module& core);
void bind_areas(Module& core);
void bind_deep(Module& core);
void bind_depth_formats(Module& core);
void bind_clipping(Module& core);
void bind_validation(Module& core);

/// The scene behind Python's Scene. What uses it has a pointer of its own meanwhile: a scene that
/// is in use is not changed, but copied (scene.cpp).
struct SharedScene {
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
};

/// The map behind Python's Map: all of it but, where Python has taken them as arrays, its channels.
using SharedMap = std::shared_ptr<DepthMap>;

/// The value that a word of Python's names, of an enumeration with name_of().
/// Fails    UsageError: "compression: expected none, rle, zips, zip or piz, found lzma".
template <class Values>
std::ranges::range_value_t<Values> named_value(const std::string& argument, const Values& values,
                                               const std::string& name) {
  if (const auto value = value_named(values, name)) return *value;
  throw UsageError(argument + ": expected " + joined(names_of(values), " or ") + ", found " + name);
}

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads);

/// uint8, height × width × 3, that owns its memory.
pybind11::array array_of(const RgbImage& picture);

}  // namespace fathom::python
