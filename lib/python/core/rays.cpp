#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/rays/ray_file.h"
#include "bindings.h"
#include "fathom/camera/trajectory.h"
#include "fathom/image/channel_names.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/hit_channels.h"
#include "fathom/rays/hit_values.h"
#include "fathom/rays/lidar_rays.h"
#include "fathom/rays/lidar_sensor.h"
#include "fathom/rays/shutter_rays.h"
#include "fathom/rays/sight.h"
#include "fathom/rendering/options.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// A scene that is prepared, and kept meanwhile.
struct PreparedRays {
  std::shared_ptr<const Scene> scene;
  RayScene rays;

  PreparedRays(std::shared_ptr<const Scene> given, int threads)
      : scene(std::move(given)), rays(*scene, threads) {}
};

using SharedRays = std::shared_ptr<const PreparedRays>;
using Numbers = ContiguousArray<double>;

std::shared_ptr<PreparedRays> prepare(const SharedScene& given, int threads) {
  const std::shared_ptr<const Scene> scene = given.scene;
  return run([&](const auto&) { return std::make_shared<PreparedRays>(scene, threads); });
}

std::vector<std::array<double, 3>> rows_of(const Numbers& numbers) {
  std::vector<std::array<double, 3>> rows(static_cast<std::size_t>(numbers.shape(0)));
  const double* from = numbers.data();
  for (std::array<double, 3>& row : rows) {
    std::copy_n(from, 3, row.begin());
    from += 3;
  }
  return rows;
}

std::vector<Ray> rays_of(const Numbers& origins, const Numbers& directions) {
  const auto o = rows_of(origins), d = rows_of(directions);
  std::vector<Ray> rays(o.size());
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = {o[i], d[i]};
  return rays;
}

CastOptions options_of(double t_min, double t_max, bool open, const std::string& cull,
                       int threads) {
  return {{t_min, t_max, open}, named_value("cull", all_culls, cull), threads};
}

/// Numbers of triangles and t, an element for each hit.
py::tuple arrays_of(const std::vector<RayHit>& hits) {
  std::vector<std::uint32_t> triangles(hits.size());
  std::vector<double> t(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    triangles[i] = hits[i].triangle;
    t[i] = hits[i].t;
  }
  return py::make_tuple(array_of(std::move(triangles)), array_of(std::move(t)));
}

py::tuple cast_rays(const SharedRays& prepared, const Numbers& origins, const Numbers& directions,
                    double t_min, double t_max, bool open, const std::string& cull, int threads) {
  const std::vector<Ray> rays = rays_of(origins, directions);
  const CastOptions options = options_of(t_min, t_max, open, cull, threads);
  return arrays_of(run([&](const auto&) { return cast(prepared->rays, rays, options); }));
}

py::tuple all_hits_of(const SharedRays& prepared, const Numbers& origins, const Numbers& directions,
                      double t_min, double t_max, bool open, const std::string& cull, int threads) {
  const std::vector<Ray> rays = rays_of(origins, directions);
  const CastOptions options = options_of(t_min, t_max, open, cull, threads);
  RayHitLists lists = run([&](const auto&) { return all_hits(prepared->rays, rays, options); });
  const py::tuple hits = arrays_of(lists.hits);
  return py::make_tuple(array_of(std::move(lists.splits)), hits[0], hits[1]);
}

py::array occluded_rays(const SharedRays& prepared, const Numbers& origins,
                        const Numbers& directions, double t_min, double t_max, bool open,
                        const std::string& cull, int threads) {
  const std::vector<Ray> rays = rays_of(origins, directions);
  const CastOptions options = options_of(t_min, t_max, open, cull, threads);
  const auto is_hit = run([&](const auto&) { return occluded(prepared->rays, rays, options); });
  return array_of(std::vector<std::uint8_t>(is_hit.begin(), is_hit.end()));
}

py::array count_of(const SharedRays& prepared, const Numbers& origins, const Numbers& directions,
                   double t_min, double t_max, bool open, const std::string& cull, int threads) {
  const std::vector<Ray> rays = rays_of(origins, directions);
  const CastOptions options = options_of(t_min, t_max, open, cull, threads);
  return array_of(run([&](const auto&) { return count_hits(prepared->rays, rays, options); }));
}

py::array winding_numbers_of(const SharedRays& prepared, const Numbers& given, int threads) {
  const auto points = rows_of(given);
  return array_of(
      run([&](const auto&) { return winding_numbers(prepared->rays, points, threads); }));
}

/// t, distance, P, bary and N of hits, and whether each is at a front face, a row for each; where
/// there is no hit, the rows have what the specification says.
template <class Real>
py::tuple values_of(const SharedRays& prepared, const Numbers& origins, const Numbers& directions,
                    const ContiguousArray<std::uint32_t>& triangles, int threads) {
  const std::vector<Ray> rays = rays_of(origins, directions);
  const std::size_t count = rays.size();
  const std::span<const std::uint32_t> met(triangles.data(), count);
  Samples<Real> t(count), distance(count), position(3 * count), weights(2 * count),
      normal(3 * count);
  std::vector<std::uint8_t> front(count);
  const std::vector<HitValues<Real>> values = run([&](const auto&) {
    return hit_values<Real>(prepared->rays.triangles(), rays, met, threads);
  });
  for (std::size_t i = 0; i < count; ++i) {
    t[i] = values[i].t;
    distance[i] = values[i].distance;
    std::ranges::copy(values[i].position, position.begin() + 3 * i);
    std::ranges::copy(values[i].barycentric, weights.begin() + 2 * i);
    std::ranges::copy(values[i].normal, normal.begin() + 3 * i);
    front[i] = values[i].front_facing ? 1 : 0;
  }
  const auto rows = static_cast<py::ssize_t>(count);
  return py::make_tuple(array_of(std::move(t), {rows}), array_of(std::move(distance), {rows}),
                        array_of(std::move(position), {rows, 3}),
                        array_of(std::move(weights), {rows, 2}),
                        array_of(std::move(normal), {rows, 3}), array_of(std::move(front)));
}

/// Object and face of triangles.
py::tuple origins_of(const SharedRays& prepared, const ContiguousArray<std::uint32_t>& triangles) {
  const auto count = static_cast<std::size_t>(triangles.size());
  const std::uint32_t* const numbers = triangles.data();
  std::vector<std::uint32_t> objects(count, no_triangle), faces(count, no_triangle);
  for (std::size_t i = 0; i < count; ++i) {
    if (numbers[i] == no_triangle) continue;
    const TriangleOrigin origin = prepared->rays.triangles().origin(numbers[i]);
    objects[i] = origin.object;
    faces[i] = origin.face;
  }
  return py::make_tuple(array_of(std::move(objects)), array_of(std::move(faces)));
}

/// Rows of coordinates if there are no triangles, else of weights.
std::vector<SightPoint> points_of(const ContiguousArray<std::uint32_t>& triangles,
                                  const Numbers& numbers) {
  std::vector<SightPoint> points(static_cast<std::size_t>(numbers.shape(0)));
  if (triangles.size() == 0) {
    std::ranges::copy(rows_of(numbers), points.begin());
  } else {
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] =
          SurfacePoint{triangles.data()[i], numbers.data()[2 * i], numbers.data()[2 * i + 1]};
  }
  return points;
}

py::array array_of_flags(const std::vector<bool>& flags) {
  return array_of(std::vector<std::uint8_t>(flags.begin(), flags.end()));
}

py::array sees_points(const SharedRays& prepared,
                      const ContiguousArray<std::uint32_t>& eye_triangles, const Numbers& eyes,
                      const ContiguousArray<std::uint32_t>& point_triangles, const Numbers& points,
                      bool pairs, const std::string& edges, int threads) {
  const auto from = points_of(eye_triangles, eyes), to = points_of(point_triangles, points);
  const SightOptions options{named_value("edges", all_edge_rules, edges), threads};
  return array_of_flags(run([&](const auto&) {
    return pairs ? sees(prepared->rays, from, to, options)
                 : sees_each(prepared->rays, from, to, options);
  }));
}

py::array seen_by_cameras(const SharedRays& prepared,
                          const ContiguousArray<std::uint32_t>& triangles, const Numbers& numbers,
                          const std::vector<Camera>& cameras, const std::string& cull,
                          int threads) {
  const auto points = points_of(triangles, numbers);
  const Cull left_out = named_value("cull", all_culls, cull);
  return array_of_flags(run(
      [&](const auto&) { return seen_by(prepared->rays, points, cameras, left_out, threads); }));
}

/// N×6 numbers.
py::array array_of_rays(const std::vector<Ray>& rays) {
  Samples<double> numbers(6 * rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::ranges::copy(rays[i].origin, numbers.begin() + 6 * i);
    std::ranges::copy(rays[i].direction, numbers.begin() + 6 * i + 3);
  }
  return array_of(std::move(numbers), {static_cast<py::ssize_t>(rays.size()), 6});
}

py::array read_rays_of(const std::string& file) {
  return array_of_rays(run([&](const auto&) { return app::read_rays(file); }));
}

/// The rays of a turn of an Ouster sensor, and the number of its beams.
py::tuple lidar_rays_of(const std::string& file, const std::optional<std::string>& poses,
                        std::optional<double> start, int threads) {
  std::uint32_t rows = 0;
  const std::vector<Ray> rays = run([&](const auto&) {
    const LidarSensor sensor = read_ouster_sensor(file);
    rows = sensor.rows;
    if (!poses) return lidar_rays(sensor, nullptr, 0, threads);
    const Trajectory path = Trajectory::read(*poses);
    return lidar_rays(sensor, &path, start.value_or(path.first_time()), threads);
  });
  return py::make_tuple(array_of_rays(rays), rows);
}

py::array shutter_rays_of(const Camera& camera, const std::string& poses, double readout,
                          std::optional<double> start, int threads) {
  return array_of_rays(run([&](const auto&) {
    const Trajectory path = Trajectory::read(poses);
    return shutter_rays(camera, path, {start.value_or(path.first_time()), readout}, threads);
  }));
}

}  // namespace

void bind_rays(Module& core) {
  const Class<PreparedRays, std::shared_ptr<PreparedRays>> rays(core, "Rays");
  core.attr("ray_channels") = names_of(hit_channel_table);
  core.def("unknown_ray_channel", [](const std::string& name) {
    return std::string(unknown_channel(name, names_of(hit_channel_table)).what());
  });
  core.def("prepare_rays", &prepare);
  core.def("cast_rays", &cast_rays);
  core.def("all_hits", &all_hits_of);
  core.def("occluded", &occluded_rays);
  core.def("count_hits", &count_of);
  core.def("winding_numbers", &winding_numbers_of);
  core.def("hit_values32", &values_of<float>);
  core.def("hit_values64", &values_of<double>);
  core.def("origins_of", &origins_of);
  core.def("sees", &sees_points);
  core.def("seen_by", &seen_by_cameras);
  core.def("read_rays", &read_rays_of);
  core.def("lidar_rays", &lidar_rays_of);
  core.def("shutter_rays", &shutter_rays_of);
}

}  // namespace fathom::python
