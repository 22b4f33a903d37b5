#include "fathom/attribution/model/named_models.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

RendererModel opengl(const std::string& name, Mapping mapping, Storage storage) {
  return {.name = name,
          .kind = RasterModel{.premultiplied = false,
                              .mapping = mapping,
                              .storage = storage,
                              .decoded_in_binary32 = true}};
}

/// VTK multiplies its matrices in binary64, with the shift of the mesh in them.
RendererModel vtk(const std::string& name, Mapping mapping, Storage storage) {
  return {.name = name,
          .kind = RasterModel{.shift_as_vtk = true,
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

/// Renderers that people name, and the models of what they store by default.
constexpr OtherName renderer_names[] = {
    {"opengl", "gl-unorm24"},      {"opengl", "gl-float32"}, {"gl", "gl-unorm24"},
    {"gl", "gl-float32"},          {"vtk", "vtk-unorm24"},   {"vtk", "vtk-float32"},
    {"pyrender", "gl-unorm24"},    {"open3d", "gl-unorm24"}, {"open3d", "float32-ray"},
    {"embree", "float32-ray"},     {"ray", "float32-ray"},   {"raytracer", "float32-ray"},
    {"raycasting", "float32-ray"}, {"blender", "cycles"}};

/// The models with the usual mapping and the storage of this name, also as graphics interfaces
/// name it: D24S8.
std::vector<std::string> models_with_storage(const std::string& name) {
  std::vector<std::string> names;
  try {
    const Storage storage = storage_named(name);
    for (const RendererModel& model : named_models()) {
      const auto* raster = std::get_if<RasterModel>(&model.kind);
      const bool is_usual = raster != nullptr && raster->mapping == Mapping::opengl;
      if (is_usual && raster->storage == storage) names.push_back(model.name);
    }
  } catch (const UnknownName&) {
    // It is no storage.
  }
  return names;
}

/// The models of the renderer and the bits of a name like "gl24" or "vtk-32".
std::vector<std::string> models_in_short(const std::string& name) {
  const std::size_t bits = name.find_first_of("0123456789");
  std::string renderer = name.substr(0, bits);
  if (renderer.ends_with('-')) renderer.pop_back();
  std::vector<std::string> names;
  if (bits == std::string::npos || renderer.empty()) return names;
  for (const RendererModel& model : named_models()) {
    const bool is_of_renderer = model.name.starts_with(renderer + "-");
    if (is_of_renderer && model.name.ends_with(name.substr(bits))) names.push_back(model.name);
  }
  return names;
}

}  // namespace

std::vector<RendererModel> named_models() {
  return {opengl("gl-unorm16", Mapping::opengl, Storage::unorm16),
          opengl("gl-unorm24", Mapping::opengl, Storage::unorm24),
          opengl("gl-unorm32", Mapping::opengl, Storage::unorm32),
          opengl("gl-float32", Mapping::opengl, Storage::float32),
          opengl("gl-float32-reversed", Mapping::reversed, Storage::float32),
          vtk("vtk-unorm16", Mapping::opengl, Storage::unorm16),
          vtk("vtk-unorm24", Mapping::opengl, Storage::unorm24),
          vtk("vtk-unorm32", Mapping::opengl, Storage::unorm32),
          vtk("vtk-float32", Mapping::opengl, Storage::float32),
          vtk("vtk-float32-reversed", Mapping::reversed, Storage::float32),
          ray("float32-ray", 0x1p-20),
          ray("cycles", 1e-3, cycles_rotation_error)};
}

bool has_clip_planes_for(const RendererModel& model, const Camera& camera) {
  return std::holds_alternative<RayModel>(model.kind) || has_clip_planes(camera);
}

bool is_of_vtk(const RendererModel& model) {
  const auto* raster = std::get_if<RasterModel>(&model.kind);
  return raster != nullptr && raster->shift_as_vtk;
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
  throw unknown_model(name);
}

UnknownName unknown_model(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> names = more;
  std::string message = "there is no model '" + name + "'; there are " + model_names();
  for (const std::string& other : more) message += "; " + other;
  for (const RendererModel& model : named_models()) names.push_back(model.name);
  std::vector<std::string> meant = models_with_storage(name);
  if (meant.empty()) meant = models_in_short(name);
  if (!meant.empty()) return {message + "; " + did_you_mean(meant), name, names};
  return unknown_name(message, name, names, renderer_names);
}

namespace {

/// The finest grid with which snapping moves corners by as much as softpipe's roundings may move an
/// edge: 12u of the image's size (docs/validation.md, "A driver that does not snap").
int bits_of_roundings(const Camera& camera) {
  const double moved = 12 * unit_roundoff<float> * (std::max(camera.width, camera.height) + 1.0);
  return static_cast<int>(std::floor(-std::log2(2 * moved)));
}

}  // namespace

DriverFacts driver_facts(const std::string& version) {
  const auto names = [&](const char* driver) { return version.find(driver) != std::string::npos; };
  if (names("llvmpipe")) return {.depth_before_snap = true, .nearest_codes = true};
  if (names("softpipe")) return {.depth_before_snap = true, .snaps = false};
  return {};
}

void set_driver_facts(const std::string& version, int subpixel_bits, const Camera& camera,
                      RendererModel& model) {
  const DriverFacts facts = driver_facts(version);
  auto& raster = std::get<RasterModel>(model.kind);
  raster.depth_before_snap = facts.depth_before_snap;
  raster.nearest_codes = facts.nearest_codes;
  raster.subpixel_bits = facts.snaps ? subpixel_bits : bits_of_roundings(camera);
  model.watertight = facts.snaps;
}

}  // namespace fathom::attribution
