#include "fathom/camera/camera.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>

#include "bindings.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/camera/camera_making.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/camera/image_points.h"
#include "fathom/camera_directions.h"
#include "fathom/image/directions.h"
#include "fathom/scene/framing.h"
#include "fathom/threads/threads.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using Path = std::filesystem::path;
using Named = std::vector<std::pair<py::str, Camera>>;

/// Names of files may be any bytes: what is no UTF-8 becomes U+FFFD, as in camera files.
py::str as_text(const std::string& name) {
  PyObject* const text =
      PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "replace");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

Camera make_camera(std::uint32_t width, std::uint32_t height, bool orthographic,
                   const std::array<double, 5>& intrinsics, double pixel_centre, const Pose& pose,
                   double near, double far, std::string name) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.model =
      orthographic ? ProjectionModel::orthographic : ProjectionModel::perspective;
  camera.projection.fx = intrinsics[0];
  camera.projection.fy = intrinsics[1];
  camera.projection.cx = intrinsics[2];
  camera.projection.cy = intrinsics[3];
  camera.projection.skew = intrinsics[4];
  camera.projection.pixel_centre = pixel_centre;
  camera.world_to_camera = pose;
  camera.near = near;
  camera.far = far;
  camera.name = std::move(name);
  require_valid(camera);
  return camera;
}

/// The model of a lens, its numbers of distortion, and where it ends.
using LensParts = std::tuple<std::string, std::vector<double>, double>;
std::optional<LensParts> lens_of(const Camera& camera) {
  const std::optional<Lens>& lens = camera.projection.lens;
  if (!lens) return std::nullopt;
  const auto* const first = lens->distortion.begin();
  return LensParts(name_of(lens->model),
                   std::vector<double>(first, first + entry_of(lens->model).distortion.size()),
                   lens->max_radius);
}

LensChoice make_lens(std::uint32_t width, std::uint32_t height, bool orthographic,
                     std::optional<double> fov, std::optional<double> focal,
                     std::optional<double> extent, double near, double far) {
  LensChoice lens;
  lens.width = width;
  lens.height = height;
  lens.model = orthographic ? ProjectionModel::orthographic : ProjectionModel::perspective;
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
std::pair<Named, Warnings> named(const std::vector<ImportedCamera>& imported, const Path& input,
                                 bool ignore_distortion, Warnings warnings = {}) {
  Named cameras;
  for (Camera& camera : chosen_cameras(imported, input.string(),
                                       {.ignore_distortion = ignore_distortion}, warnings)) {
    py::str name = as_text(camera.name);
    cameras.emplace_back(std::move(name), std::move(camera));
  }
  return {std::move(cameras), std::move(warnings)};
}

void bind_making(Module& core) {
  Class<LensChoice>(core, "Lens").def(py::init(&make_lens));
  Class<View>(core, "View").def(py::init(&make_view));
  core.def("look_at", &look_at);
  core.def("orbit", [](const View& first, std::uint32_t count, const Vector3& centre,
                       double distance, const LensChoice& lens) {
    return run([&](const auto& progress) {
      return orbit(first, count, centre, distance, lens, progress);
    });
  });
  core.def("frame_scene", [](const SharedScene& shared, const View& view, const LensChoice& lens) {
    const std::shared_ptr<const Scene> scene = shared.scene;
    return run([&](const auto&) { return frame_scene(*scene, view, lens); });
  });
  core.def("orbit_scene", [](const SharedScene& shared, const View& first, std::uint32_t count,
                             const LensChoice& lens) {
    const std::shared_ptr<const Scene> scene = shared.scene;
    return run(
        [&](const auto& progress) { return orbit_scene(first, count, *scene, lens, progress); });
  });
}

using Numbers = ContiguousArray<double>;

/// A row of `columns` numbers for each of `count` points; work(i, row) fills it.
template <class Work>
py::array rows_of(std::size_t count, std::size_t columns, const Work& work) {
  Samples<double> numbers(count * columns);
  run([&](const auto& progress) {
    constexpr std::size_t part = 256;
    const std::size_t parts = (count + part - 1) / part;
    Progress done(progress, parts);
    parallel_for(std::size_t{0}, parts, [&](std::size_t number) {
      const std::size_t end = std::min((number + 1) * part, count);
      for (std::size_t i = number * part; i < end; ++i) work(i, &numbers[i * columns]);
      done.part_done();
    });
  });
  return array_of(std::move(numbers),
                  {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(columns)});
}

ImageRays rays_of(const Camera& camera, const std::string& frame) {
  return {camera, named_value("frame", all_point_frames, frame)};
}

/// Python has made sure of the shapes, N×3, N×2 and N, and that the numbers are finite.
void bind_image_points(Module& core) {
  core.def("project", [](const Camera& camera, const Numbers& points) {
    const double* const first = points.data();
    return rows_of(static_cast<std::size_t>(points.shape(0)), 3, [&](std::size_t i, double* row) {
      const ImageOfPoint image =
          project(camera, {first[3 * i], first[3 * i + 1], first[3 * i + 2]});
      row[0] = image.u;
      row[1] = image.v;
      row[2] = image.depth;
    });
  });
  core.def("unproject", [](const Camera& camera, const Numbers& pixels, const Numbers& depths,
                           const std::string& frame) {
    const ImageRays rays = rays_of(camera, frame);
    const double *const pixel = pixels.data(), *const depth = depths.data();
    return rows_of(static_cast<std::size_t>(depths.size()), 3, [&](std::size_t i, double* row) {
      std::ranges::copy(rays.point(pixel[2 * i], pixel[2 * i + 1], depth[i]), row);
    });
  });
  core.def("rays_of_pixels", [](const Camera& camera, const std::string& frame) {
    const ImageRays rays = rays_of(camera, frame);
    const std::size_t width = camera.width;
    return rows_of(width * camera.height, 3, [&](std::size_t i, double* row) {
      std::ranges::copy(rays.of_pixel(static_cast<std::uint32_t>(i % width),
                                      static_cast<std::uint32_t>(i / width)),
                        row);
    });
  });
  core.def("resized", &resized);
  core.def("scaled", &scaled);
  core.def("with_size", [](Camera camera, std::uint32_t width, std::uint32_t height) {
    camera.width = width;
    camera.height = height;
    require_valid(camera);
    return camera;
  });
}

void bind_importing(Module& core) {
  core.def("import_colmap", [](const Path& folder, bool ignore_distortion) {
    return named(import_colmap(folder), folder, ignore_distortion);
  });
  core.def("import_nerf",
           [](const Path& file, std::uint32_t width, std::uint32_t height, bool ignore_distortion) {
             Warnings warnings;
             const auto imported = import_nerf(file, width, height, warnings);
             return named(imported, file, ignore_distortion, std::move(warnings));
           });
  core.def("import_bop", [](const Path& file, std::uint32_t width, std::uint32_t height) {
    return named(import_bop(file, width, height), file, false);
  });
  core.def("import_sfm_data", [](const Path& file, bool ignore_distortion) {
    return named(import_sfm_data(file), file, ignore_distortion);
  });
  core.def("import_gltf", [](const Path& file, std::uint32_t width, std::uint32_t height) {
    return named(import_gltf(file, width, height), file, false);
  });
  core.def("camera_from_opengl", &camera_from_opengl);
  core.def("cameras_from_json", [](const std::string& text, const std::string& name, bool is_file) {
    Warnings warnings;
    const DirectionReader directions = is_file ? directions_beside(name) : DirectionReader();
    auto cameras = read_cameras(std::string_view(text), name, warnings, directions);
    return std::pair(std::move(cameras), std::move(warnings));
  });
  core.def("cameras_to_json", [](const std::vector<Camera>& cameras) { return to_json(cameras); });
  core.def("camera_to_json", [](const Camera& camera) { return to_json(camera); });
}

/// Of a camera with a table: whether the table is from a file, and has been read.
struct TableState {
  bool is_read, has_file;
};
std::optional<TableState> table_state(const Camera& camera) {
  if (!camera.projection.lens || !camera.projection.lens->directions) return std::nullopt;
  const DirectionTable& table = *camera.projection.lens->directions;
  return TableState{table.is_read(), !table.source().path.empty()};
}

/// H×W×3.
py::array array_of(const DirectionTable& table) {
  Samples<double> numbers(table.numbers().size());
  std::ranges::copy(table.numbers(), numbers.begin());
  return python::array_of(std::move(numbers),
                          {static_cast<py::ssize_t>(table.height()),
                           static_cast<py::ssize_t>(table.width()), py::ssize_t{3}});
}

/// A camera file's text with a table that is not read, and the numbers of the table.
Camera camera_with_table(const std::string& text, const Numbers& numbers) {
  Camera camera = read_cameras(text, "camera").at(0);
  std::shared_ptr<const DirectionTable>& table = camera.projection.lens->directions;
  table = std::make_shared<const DirectionTable>(
      camera.width, camera.height,
      std::vector<double>(numbers.data(), numbers.data() + numbers.size()), table->source());
  require_valid(camera);
  return camera;
}

void bind_directions(Module& core) {
  core.def("directions_of", [](const Camera& camera) {
    return array_of(run([&](const auto& progress) {
      return directions_of(camera, DirectionRounding::binary64, progress);
    }));
  });
  core.def("camera_with_table", &camera_with_table);
  core.def("table_of", [](const Camera& camera) -> std::optional<py::array> {
    const std::optional<TableState> state = table_state(camera);
    if (!state || !state->is_read) return std::nullopt;
    return array_of(*camera.projection.lens->directions);
  });
  core.def("has_table_without_file", [](const Camera& camera) {
    const std::optional<TableState> state = table_state(camera);
    return state && !state->has_file;
  });
}

PoseDirection direction_of(bool camera_to_world) {
  return camera_to_world ? PoseDirection::camera_to_world : PoseDirection::world_to_camera;
}

void bind_data_sets(Module& core) {
  Class<GivenLens>(core, "GivenLens")
      .def(py::init([](std::uint32_t width, std::uint32_t height, std::optional<IntrinsicMatrix> K,
                       std::optional<double> pixel_centre) {
        return GivenLens{width, height, K, pixel_centre};
      }));
  core.def("import_matrices",
           [](const std::vector<std::pair<std::string, Pose>>& poses,
              const std::vector<IntrinsicMatrix>& K, bool camera_to_world, bool opengl,
              double pixel_centre, std::uint32_t width, std::uint32_t height) {
             std::vector<NamedPose> named_poses;
             named_poses.reserve(poses.size());
             for (const auto& [name, pose] : poses) named_poses.push_back({name, pose});
             const MatrixConvention convention{direction_of(camera_to_world),
                                               opengl ? CameraAxes::opengl : CameraAxes::opencv,
                                               pixel_centre};
             return named(import_matrices(named_poses, K, convention, width, height, "poses"),
                          "poses", false);
           });
  core.def("import_tum",
           [](const Path& trajectory, const std::optional<Path>& images, const std::string& lens,
              const GivenLens& given, bool ignore_distortion) {
             std::optional<ImportedCamera> published = tum_lens(lens);
             if (published && given.width != 0) {
               published->camera.width = given.width;
               published->camera.height = given.height;
             }
             if (published && given.pixel_centre)
               published->camera.projection.pixel_centre = *given.pixel_centre;
             return named(import_tum(trajectory, images, published ? *published : tum_lens(given)),
                          trajectory, ignore_distortion);
           });
  core.def("import_7scenes", [](const Path& folder, const GivenLens& given) {
    return named(import_7scenes(folder, given), folder, false);
  });
  core.def("import_scannet", [](const Path& folder, bool colour, const GivenLens& given) {
    const ScanNetStream stream = colour ? ScanNetStream::colour : ScanNetStream::depth;
    return named(import_scannet(folder, stream, given), folder, false);
  });
  core.def("import_scannetpp", [](const Path& file, const GivenLens& given) {
    return named(import_scannetpp(file, given), file, false);
  });
  core.def("import_replica", [](const Path& folder, const GivenLens& given) {
    return named(import_replica(folder, given), folder, false);
  });
  core.def("import_kitti", [](const Path& calibration, const std::optional<Path>& poses,
                              std::optional<std::uint32_t> number, const GivenLens& given) {
    return named(import_kitti(calibration, poses, number, given), calibration, false);
  });
}

/// Python shows the numbers of the projection as attributes of the camera.
auto number(double Projection::*member) {
  return [member](const Camera& camera) { return camera.projection.*member; };
}

}  // namespace

void bind_camera(Module& core) {
  Class<Camera>(core, "Camera")
      .def(py::init(&make_camera))
      .def_readonly("width", &Camera::width)
      .def_readonly("height", &Camera::height)
      .def_property_readonly(
          "orthographic", [](const Camera& camera) { return is_orthographic(camera.projection); })
      .def_property_readonly("fx", number(&Projection::fx))
      .def_property_readonly("fy", number(&Projection::fy))
      .def_property_readonly("cx", number(&Projection::cx))
      .def_property_readonly("cy", number(&Projection::cy))
      .def_property_readonly("skew", number(&Projection::skew))
      .def_property_readonly("pixel_centre", number(&Projection::pixel_centre))
      .def_property_readonly("lens", &lens_of)
      .def_readonly("world_to_camera", &Camera::world_to_camera)
      .def_readonly("near", &Camera::near)
      .def_readonly("far", &Camera::far)
      .def_property_readonly("name", [](const Camera& camera) { return as_text(camera.name); })
      .def_property_readonly("camera_to_world", [](const Camera& camera) {
        return camera_to_world(camera.world_to_camera);
      });
  bind_making(core);
  bind_image_points(core);
  bind_importing(core);
  bind_data_sets(core);
  bind_directions(core);
}

}  // namespace fathom::python
