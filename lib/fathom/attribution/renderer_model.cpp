#include "fathom/attribution/renderer_model.h"

#include <cmath>
#include <limits>
#include <vector>

#include "fathom/numeric/errors.h"

namespace fathom::attribution {
namespace {

RendererModel raster(const std::string& name, Mapping mapping, Storage storage) {
  RendererModel model{.name = name, .mapping = mapping, .storage = storage};
  model.premultiplied = false;
  model.decoded_in_binary32 = true;
  return model;
}

RendererModel ray(const std::string& name, double sample_error) {
  RendererModel model{.name = name, .kind = RendererModel::Kind::ray};
  model.sample_error = sample_error;
  model.depth_from_point = true;
  model.watertight = false;
  return model;
}

/// Blender keeps a camera's rotation as three angles: each is up to 6u off (atan2 of rounded
/// numbers, up to π), and their sines and products are six roundings more.
RendererModel cycles() {
  RendererModel model = ray("cycles", 1e-3);
  model.rotation_error = 24 * 0x1p-24;
  return model;
}

std::vector<RendererModel> models() {
  return {raster("gl-unorm16", Mapping::opengl, Storage::unorm16),
          raster("gl-unorm24", Mapping::opengl, Storage::unorm24),
          raster("gl-unorm32", Mapping::opengl, Storage::unorm32),
          raster("gl-float32", Mapping::opengl, Storage::float32),
          raster("gl-float32-reversed", Mapping::reversed, Storage::float32),
          ray("float32-ray", 0x1p-20),
          cycles()};
}

}  // namespace

double WindowDepth::of_depth(double depth) const {
  if (log_range != 0) return std::log(depth / near) / log_range;
  return perspective ? a + b / depth : a * depth + b;
}

double WindowDepth::to_depth(double window) const {
  if (log_range != 0) return near * std::exp(window * log_range);
  if (!perspective) return (window - b) / a;
  const double beyond = window - a;  // of the sign of b in front of the camera
  if (beyond == 0 || (beyond > 0) != (b > 0)) return std::numeric_limits<double>::infinity();
  return b / beyond;
}

WindowDepth window_depth(Projection projection, Mapping mapping, double near, double far) {
  WindowDepth window{.perspective = projection == Projection::perspective,
                     .minus_one_to_one = mapping == Mapping::opengl};
  if (mapping == Mapping::log_ulrich) {
    window.near = near;
    window.log_range = std::log(far / near);
    return window;
  }
  const bool reversed = is_reversed(mapping);
  if (takes_infinite_far(mapping)) {
    window.a = reversed ? 0 : 1;
    window.b = reversed ? near : -near;
    return window;
  }
  const double range = far - near;
  if (window.perspective) {
    window.a = reversed ? -near / range : far / range;
    window.b = (reversed ? far : -far) * near / range;
  } else {
    window.a = (reversed ? -1 : 1) / range;
    window.b = (reversed ? far : -near) / range;
  }
  return window;
}

std::string model_names() {
  std::string names;
  for (const RendererModel& model : models()) names += (names.empty() ? "" : ", ") + model.name;
  return names;
}

RendererModel model_named(const std::string& name) {
  for (const RendererModel& model : models()) {
    if (model.name == name) return model;
  }
  throw UsageError("--model: there is no model '" + name + "'; there are " + model_names());
}

}  // namespace fathom::attribution
