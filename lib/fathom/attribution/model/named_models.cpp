#include "fathom/attribution/model/named_models.h"

#include <variant>

#include "fathom/camera/clip_planes.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

RendererModel raster(const std::string& name, Mapping mapping, Storage storage) {
  return {.name = name,
          .kind = RasterModel{.premultiplied = false,
                              .mapping = mapping,
                              .storage = storage,
                              .decoded_in_binary32 = true}};
}

/// `sample_error` and `rotation_error` as in the models.
RendererModel ray(const std::string& name, double sample_error, double rotation_error = 0) {
  return {.name = name,
          .sample = {.error = sample_error},
          .watertight = false,
          .kind = RayModel{.rotation_error = rotation_error, .depth_from_point = true}};
}

/// Blender keeps a camera's rotation as three angles: each is up to 6u off (atan2 of rounded
/// numbers, up to π), and their sines and products are six roundings more.
constexpr double cycles_rotation_error = 24 * unit_roundoff<float>;

}  // namespace

std::vector<RendererModel> named_models() {
  return {raster("gl-unorm16", Mapping::opengl, Storage::unorm16),
          raster("gl-unorm24", Mapping::opengl, Storage::unorm24),
          raster("gl-unorm32", Mapping::opengl, Storage::unorm32),
          raster("gl-float32", Mapping::opengl, Storage::float32),
          raster("gl-float32-reversed", Mapping::reversed, Storage::float32),
          ray("float32-ray", 0x1p-20),
          ray("cycles", 1e-3, cycles_rotation_error)};
}

bool has_clip_planes_for(const RendererModel& model, const Camera& camera) {
  return std::holds_alternative<RayModel>(model.kind) || has_clip_planes(camera);
}

std::string model_names() {
  std::string names;
  for (const RendererModel& model : named_models())
    names += (names.empty() ? "" : ", ") + model.name;
  return names;
}

RendererModel model_named(const std::string& name) {
  for (const RendererModel& model : named_models()) {
    if (model.name == name) return model;
  }
  throw UsageError("there is no model '" + name + "'; there are " + model_names());
}

}  // namespace fathom::attribution
