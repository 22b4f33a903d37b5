#include "apps/study/lens/lens_maps.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "fathom/camera_directions.h"
#include "fathom/lens/preimages.h"
#include "fathom/render.h"

namespace fathom::studies {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;
using Place = std::array<double, 2>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr PlanePoint no_ray{nan, nan};

bool has_ray(const PlanePoint& ray) {
  return !std::isnan(ray[0]);
}

Vector3d direction_of(const PlanePoint& ray) {
  return {ray[0], ray[1], 1};
}

Vector3d vector_of(const MeshPoint& p) {
  return {p.x, p.y, p.z};
}

Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = vector_of(mesh.vertices[mesh.triangles[triangle][k]]);
  return corners;
}

/// The z at which a ray meets the plane of a triangle.
double depth_on(const Corners& corners, const PlanePoint& ray) {
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  return normal.dot(corners[0]) / normal.dot(direction_of(ray));
}

/// The visible triangles, pixel by pixel.
Samples<std::uint32_t> visible_triangles(const Scene& scene, const Camera& camera) {
  DepthMap map = render(scene, camera, {.channels = {Channel::id}}).map;
  return std::move(*map.values<std::uint32_t>("id"));
}

std::size_t pixels_of(const Camera& camera) {
  return static_cast<std::size_t>(camera.width) * camera.height;
}

/// The centre of a pixel, from the top left corner of the image.
Place centre_of(const Camera& camera, std::size_t pixel) {
  const std::size_t column = pixel % camera.width, row = pixel / camera.width;
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

std::vector<PlanePoint> rays_of(const DirectionTable& table) {
  std::vector<PlanePoint> rays;
  for (std::uint32_t row = 0; row < table.height(); ++row) {
    for (std::uint32_t column = 0; column < table.width(); ++column) {
      const auto d = table.at(column, row);
      rays.push_back(d ? PlanePoint{(*d)[0] / (*d)[2], (*d)[1] / (*d)[2]} : no_ray);
    }
  }
  return rays;
}

/// A camera whose pixels have these rays.
Camera camera_with(const std::vector<PlanePoint>& rays, const Camera& size) {
  std::vector<double> numbers;
  numbers.reserve(3 * rays.size());
  for (const PlanePoint& ray : rays)
    numbers.insert(numbers.end(), {ray[0], ray[1], has_ray(ray) ? 1.0 : 0.0});
  Camera camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(size.width, size.height, std::move(numbers));
  return camera;
}

/// What rays show, given the triangles that they see.
ShownMap shown_by(std::vector<PlanePoint> rays, const Samples<std::uint32_t>& triangles,
                  const LensScene& scene) {
  ShownMap shown{std::move(rays), {}, {}};
  for (std::size_t i = 0; i < shown.rays.size(); ++i) {
    const bool sees = triangles[i] != no_surface;
    shown.surfaces.push_back(sees ? scene.surfaces[triangles[i]] : no_surface);
    shown.depths.push_back(
        sees ? depth_on(corners_of(scene.scene.meshes[0], triangles[i]), shown.rays[i]) : infinity);
  }
  return shown;
}

Camera camera_through(const Camera& pinhole, const Lens& lens) {
  Camera camera = pinhole;
  camera.projection.lens = lens;
  return camera;
}

}  // namespace

LensView::LensView(const LensScene& scene, const Lens& lens)
    : scene_(scene),
      camera_(camera_through(scene.pinhole, lens)),
      stage_(lens::stage_of(lens)),
      end_(std::min(lens::Preimages(camera_.projection, lens).disc(),
                    lens.max_radius * lens.max_radius)),
      exact_(shown_by(rays_of(directions_of(camera_)), visible_triangles(scene.scene, camera_),
                      scene)) {}

PlanePoint LensView::distorted_point(std::size_t pixel) const {
  const auto [u, v] = centre_of(camera_, pixel);
  return RoundedProjection(camera_.projection).plane_point_at(u, v);
}

std::optional<Place> LensView::place_of(const PlanePoint& ray) const {
  const auto [x, y] = ray;
  if (!(x * x + y * y <= end_)) return std::nullopt;
  const auto [x_d, y_d] = lens::stage_value<double>(stage_, x, y);
  return RoundedProjection(camera_.projection).image_of({x_d, y_d, 1});
}

ShownMap map_by_inverse(const LensView& view, const Inverse& inverse) {
  std::vector<PlanePoint> rays(pixels_of(view.camera()), no_ray);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (const auto ray = inverse(view.stage(), view.distorted_point(i));
        ray && std::isfinite((*ray)[0]) && std::isfinite((*ray)[1]))
      rays[i] = *ray;
  const Samples<std::uint32_t> triangles =
      visible_triangles(view.scene().scene, camera_with(rays, view.camera()));
  return shown_by(std::move(rays), triangles, view.scene());
}

namespace {

/// A map of a pinhole, three times as wide and as high as the image.
class PinholeMap {
 public:
  explicit PinholeMap(const LensScene& scene)
      : scene_(scene),
        camera_(wider(scene.pinhole)),
        projection_(camera_.projection),
        triangles_(visible_triangles(scene.scene, camera_)) {}

  /// The place of a ray, in pixels.
  [[nodiscard]] Place place_of(const PlanePoint& ray) const {
    return projection_.image_of({ray[0], ray[1], 1});
  }

  /// What a pixel of the map shows, given by its integer place; nothing beyond the map.
  struct Pixel {
    PlanePoint ray = no_ray;
    std::uint32_t surface = no_surface;
    double depth = infinity;
  };
  [[nodiscard]] Pixel at(double column, double row) const {
    if (!(column >= 0 && row >= 0 && column < camera_.width && row < camera_.height)) return {};
    const auto pixel =
        static_cast<std::size_t>(row) * camera_.width + static_cast<std::size_t>(column);
    Pixel shown{projection_.plane_point_at(column + 0.5, row + 0.5)};
    const std::uint32_t triangle = triangles_[pixel];
    if (triangle == no_surface) return shown;
    shown.surface = scene_.surfaces[triangle];
    shown.depth = depth_on(corners_of(scene_.scene.meshes[0], triangle), shown.ray);
    return shown;
  }

 private:
  static Camera wider(Camera camera) {
    camera.projection.cx += camera.width;
    camera.projection.cy += camera.height;
    camera.width *= 3;
    camera.height *= 3;
    return camera;
  }

  const LensScene& scene_;
  Camera camera_;
  RoundedProjection projection_;
  Samples<std::uint32_t> triangles_;
};

/// The mean of the four pixels around a place.
PinholeMap::Pixel mean_at(const PinholeMap& map, const PlanePoint& ray) {
  const auto [u, v] = map.place_of(ray);
  const double column = std::floor(u - 0.5), row = std::floor(v - 0.5);
  const double right = u - 0.5 - column, down = v - 0.5 - row;
  PinholeMap::Pixel mean{.depth = 0};
  bool is_first = true;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const double weight = (x == 0 ? 1 - right : right) * (y == 0 ? 1 - down : down);
      if (weight == 0) continue;
      const PinholeMap::Pixel pixel = map.at(column + x, row + y);
      if (pixel.surface == no_surface) return {};
      if (!is_first && pixel.surface != mean.surface) mean.surface = mixed_surfaces;
      if (is_first) mean.surface = pixel.surface;
      mean.depth += weight * pixel.depth;
      is_first = false;
    }
  }
  return mean;
}

}  // namespace

ShownMap map_by_lookup(const LensView& view, Lookup lookup) {
  const PinholeMap map(view.scene());
  ShownMap shown;
  for (const PlanePoint& ray : view.exact().rays) {
    PinholeMap::Pixel pixel;
    if (has_ray(ray) && lookup == Lookup::bilinear) pixel = mean_at(map, ray);
    if (has_ray(ray) && lookup == Lookup::nearest) {
      const auto [u, v] = map.place_of(ray);
      pixel = map.at(std::floor(u), std::floor(v));
    }
    shown.rays.push_back(pixel.ray);
    shown.surfaces.push_back(pixel.surface);
    shown.depths.push_back(pixel.depth);
  }
  return shown;
}

namespace {

/// Adds a triangle's pieces: the corners (i, j), 0 ≤ j ≤ i ≤ parts, of which (0, 0) is A,
/// (parts, 0) is B and (parts, parts) is C. Neighbours have the same numbers on their common edge.
void add_pieces(std::vector<MeshPoint>& points, Mesh& pieces, const Corners& corners, int parts) {
  const auto first = static_cast<std::uint32_t>(points.size());
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Vector3d sum = (parts - i) * corners[0] + (i - j) * corners[1] + j * corners[2];
      const Vector3d p = sum / parts;
      points.push_back({p.x(), p.y(), p.z()});
    }
  }
  const auto number = [first](int i, int j) {
    return first + static_cast<std::uint32_t>(i * (i + 1) / 2 + j);
  };
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j <= i; ++j) {
      pieces.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      if (j < i) pieces.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
}

/// The point at the same depth that a pinhole shows where the lens shows p.
std::optional<MeshPoint> bent(const LensView& view, const MeshPoint& p) {
  if (!(p.z > 0)) return std::nullopt;
  const auto place = view.place_of({p.x / p.z, p.y / p.z});
  if (!place) return std::nullopt;
  const auto [x, y] =
      RoundedProjection(view.camera().projection).plane_point_at((*place)[0], (*place)[1]);
  return MeshPoint{x * p.z, y * p.z, p.z};
}

}  // namespace

BentMesh bend_vertices(const LensView& view, int parts) {
  BentMesh result{parts, {}, {}};
  Mesh mesh;
  const Mesh& whole = view.scene().scene.meshes[0];
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t)
    add_pieces(result.points, mesh, corners_of(whole, t), parts);
  std::vector<bool> is_moved;
  for (const MeshPoint& p : result.points) {
    const auto moved = bent(view, p);
    is_moved.push_back(moved.has_value());
    mesh.vertices.push_back(moved.value_or(p));
  }
  for (CornerIndices& t : mesh.triangles)
    if (!is_moved[t[0]] || !is_moved[t[1]] || !is_moved[t[2]]) t = {t[0], t[0], t[0]};
  mesh.face_count = mesh.triangles.size();
  result.bent.meshes = {std::move(mesh)};
  result.bent.objects = {{.name = "bent"}};
  return result;
}

BentMap map_by_vertices(const LensView& view, const BentMesh& mesh) {
  const Camera& pinhole = view.scene().pinhole;
  const RoundedProjection projection(pinhole.projection);
  const Mesh& bent = mesh.bent.meshes[0];
  const auto pieces = static_cast<std::uint32_t>(mesh.parts * mesh.parts);
  const Samples<std::uint32_t> triangles = visible_triangles(mesh.bent, pinhole);
  BentMap map{{std::vector<PlanePoint>(triangles.size(), no_ray),
               std::vector<std::uint32_t>(triangles.size(), no_surface),
               std::vector<double>(triangles.size(), infinity)},
              0};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] == no_surface) continue;
    const auto [a, b, c] = corners_of(bent, triangles[i]);
    const auto [u, v] = centre_of(pinhole, i);
    const Vector3d d = direction_of(projection.plane_point_at(u, v));
    // The weights of B and C at the point of the piece that the pixel sees.
    const Vector3d normal = (b - a).cross(c - a);
    const double of_b = c.cross(a).dot(d) / normal.dot(d);
    const double of_c = a.cross(b).dot(d) / normal.dot(d);
    const CornerIndices& t = bent.triangles[triangles[i]];
    const Vector3d p = (1 - of_b - of_c) * vector_of(mesh.points[t[0]]) +
                       of_b * vector_of(mesh.points[t[1]]) + of_c * vector_of(mesh.points[t[2]]);
    map.shown.rays[i] = {p.x() / p.z(), p.y() / p.z()};
    map.shown.surfaces[i] = view.scene().surfaces[triangles[i] / pieces];
    map.shown.depths[i] = p.z();
    const auto image = [&](const Vector3d& corner) {
      const auto [x, y] = projection.image_of({corner.x(), corner.y(), corner.z()});
      return Eigen::Vector2d(x, y);
    };
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      map.longest_edge = std::max(map.longest_edge, (image(to) - image(from)).norm());
  }
  return map;
}

namespace {

/// How far the point that a pixel shows is from its place, in pixels; nullopt if the lens shows it
/// nowhere.
std::optional<double> pixels_off(const ShownMap& shown, const LensView& view, std::size_t pixel) {
  const auto place = view.place_of(shown.rays[pixel]);
  if (!place) return std::nullopt;
  const auto [u, v] = centre_of(view.camera(), pixel);
  return std::hypot((*place)[0] - u, (*place)[1] - v);
}

/// The relative error of the depth; nullopt unless both maps show the same surface.
std::optional<double> depth_off(const ShownMap& shown, const ShownMap& exact, std::size_t pixel) {
  if (shown.surfaces[pixel] != exact.surfaces[pixel] || exact.surfaces[pixel] == no_surface)
    return std::nullopt;
  return std::abs(shown.depths[pixel] - exact.depths[pixel]) / exact.depths[pixel];
}

/// Counts a pixel's surface.
void count_surface(LensErrors& errors, std::uint32_t shown, std::uint32_t exact) {
  errors.surface_pixels += exact != no_surface ? 1 : 0;
  if (shown == exact) return;
  if (shown == no_surface) {
    ++errors.missing;
  } else if (exact == no_surface) {
    ++errors.invented;
  } else {
    ++errors.other_surface;
  }
}

}  // namespace

LensErrors errors_of(const ShownMap& shown, const LensView& view) {
  LensErrors errors;
  const ShownMap& exact = view.exact();
  std::uint64_t measured = 0;
  double greatest = 0, sum = 0;
  for (std::size_t i = 0; i < exact.rays.size(); ++i) {
    count_surface(errors, shown.surfaces[i], exact.surfaces[i]);
    errors.greatest_depth = std::max(errors.greatest_depth, depth_off(shown, exact, i).value_or(0));
    errors.rays += has_ray(exact.rays[i]) ? 1 : 0;
    if (!has_ray(shown.rays[i])) continue;
    if (!has_ray(exact.rays[i])) {
      ++errors.invented_rays;
    } else if (const auto pixels = pixels_off(shown, view, i)) {
      greatest = std::max(greatest, *pixels);
      sum += *pixels;
      ++measured;
    } else {
      ++errors.beyond;
    }
  }
  if (measured > 0) {
    errors.greatest = greatest;
    errors.mean = sum / static_cast<double>(measured);
  }
  return errors;
}

DepthMap error_map(const ShownMap& shown, const LensView& view) {
  const auto in_binary32 = [](const std::optional<double>& x) {
    return static_cast<float>(x.value_or(infinity));
  };
  std::vector<float> depths, pixels, depth_errors;
  for (std::size_t i = 0; i < shown.rays.size(); ++i) {
    depths.push_back(static_cast<float>(shown.depths[i]));
    pixels.push_back(in_binary32(pixels_off(shown, view, i)));
    depth_errors.push_back(in_binary32(depth_off(shown, view.exact(), i)));
  }
  DepthMap map{.width = view.camera().width, .height = view.camera().height};
  map.channels = {
      {"Z", std::move(depths)}, {"pixels", std::move(pixels)}, {"depth", std::move(depth_errors)}};
  return map;
}

}  // namespace fathom::studies
