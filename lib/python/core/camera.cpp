#include "fathom/camera/camera.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>

#include "bindings.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/framing.h"
#include "running.h"
#include "scene.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using Rows = std::array<std::array<double, 4>, 3>;
using Named = std::vector<std::pair<std::string, Camera>>;

Camera make_camera(std::uint32_t width, std::uint32_t height, bool orthographic,
                   const std::array<double, 5>& intrinsics, double pixel_centre, const Rows& pose,
                   double near, double far) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection = orthographic ? Projection::orthographic : Projection::perspective;
  camera.fx = intrinsics[0];
  camera.fy = intrinsics[1];
  camera.cx = intrinsics[2];
  camera.cy = intrinsics[3];
  camera.skew = intrinsics[4];
  camera.pixel_centre = pixel_centre;
  camera.world_to_camera = pose;
  camera.near = near;
  camera.far = far;
  require_valid(camera);
  return camera;
}

Lens make_lens(std::uint32_t width, std::uint32_t height, bool orthographic,
               std::optional<double> fov, std::optional<double> focal, std::optional<double> extent,
               double near, double far) {
  Lens lens;
  lens.width = width;
  lens.height = height;
  lens.projection = orthographic ? Projection::orthographic : Projection::perspective;
  if (fov) lens.vertical_fov = *fov;
  lens.focal = focal;
  lens.vertical_extent = extent;
  lens.near = near;
  lens.far = far;
  return lens;
}

View make_view(double azimuth, double elevation, const Vector3& up) {
  return {azimuth, elevation, up};
}

/// Cameras by name, and what is to be warned of.
std::pair<Named, Warnings> named(const std::vector<ImportedCamera>& imported,
                                 const std::filesystem::path& input, bool ignore_distortion,
                                 Warnings warnings = {}) {
  Named cameras;
  for (Camera& camera : chosen_cameras(imported, input.string(),
                                       {.ignore_distortion = ignore_distortion}, warnings)) {
    std::string name = camera.name;
    cameras.emplace_back(std::move(name), std::move(camera));
  }
  return {std::move(cameras), std::move(warnings)};
}

void bind_making(py::module_& core) {
  py::class_<Lens>(core, "Lens").def(py::init(&make_lens));
  py::class_<View>(core, "View").def(py::init(&make_view));
  core.def("look_at", &look_at);
  core.def("orbit", [](const View& first, std::uint32_t count, const Vector3& centre,
                       double distance, const Lens& lens) {
    return run([&](const auto& progress) {
      return orbit(first, count, centre, distance, lens, progress);
    });
  });
  core.def("frame_scene", [](const SharedScene& shared, const View& view, const Lens& lens) {
    const std::shared_ptr<const Scene> scene = shared.scene;
    return run([&](const auto&) { return frame_scene(*scene, view, lens); });
  });
  core.def("orbit_scene",
           [](const SharedScene& shared, const View& first, std::uint32_t count, const Lens& lens) {
             const std::shared_ptr<const Scene> scene = shared.scene;
             return run([&](const auto& progress) {
               return orbit_scene(first, count, *scene, lens, progress);
             });
           });
}

void bind_importing(py::module_& core) {
  core.def("import_colmap", [](const std::filesystem::path& folder, bool ignore_distortion) {
    return named(import_colmap(folder), folder, ignore_distortion);
  });
  core.def("import_nerf", [](const std::filesystem::path& file, std::uint32_t width,
                             std::uint32_t height, bool ignore_distortion) {
    Warnings warnings;
    const auto imported = import_nerf(file, width, height, warnings);
    return named(imported, file, ignore_distortion, std::move(warnings));
  });
  core.def("import_bop",
           [](const std::filesystem::path& file, std::uint32_t width, std::uint32_t height) {
             return named(import_bop(file, width, height), file, false);
           });
  core.def("camera_from_opengl", &camera_from_opengl);
  core.def("cameras_from_json", [](const std::string& text, const std::string& name) {
    Warnings warnings;
    auto cameras = read_cameras(std::string_view(text), name, warnings);
    return std::pair(std::move(cameras), std::move(warnings));
  });
  core.def("cameras_to_json", [](const std::vector<Camera>& cameras) { return to_json(cameras); });
  core.def("camera_to_json", [](const Camera& camera) { return to_json(camera); });
}

}  // namespace

void bind_camera(py::module_& core) {
  py::class_<Camera>(core, "Camera")
      .def(py::init(&make_camera))
      .def_readonly("width", &Camera::width)
      .def_readonly("height", &Camera::height)
      .def_property_readonly(
          "orthographic",
          [](const Camera& camera) { return camera.projection == Projection::orthographic; })
      .def_readonly("fx", &Camera::fx)
      .def_readonly("fy", &Camera::fy)
      .def_readonly("cx", &Camera::cx)
      .def_readonly("cy", &Camera::cy)
      .def_readonly("skew", &Camera::skew)
      .def_readonly("pixel_centre", &Camera::pixel_centre)
      .def_readonly("world_to_camera", &Camera::world_to_camera)
      .def_readonly("near", &Camera::near)
      .def_readonly("far", &Camera::far)
      .def_readonly("name", &Camera::name)
      .def_property_readonly("camera_to_world",
                             [](const Camera& camera) { return camera_to_world(camera); });
  bind_making(core);
  bind_importing(core);
}

}  // namespace fathom::python
