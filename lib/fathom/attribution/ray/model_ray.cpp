#include "fathom/attribution/ray/model_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/lens_samples.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/sample_grid.h"
#include "fathom/numeric/standard_arithmetic.h"

// docs/validation.md, "A ray tracer", derives the bounds in this file.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// The camera in a world whose origin is `shift`.
Camera moved(Camera camera, const Vector3& shift) {
  auto camera_from_world = as_matrix(camera.world_to_camera);
  camera_from_world.col(3) += camera_from_world.leftCols<3>() * shift;
  return camera;
}

/// −Rᵀt; used where R is a rotation.
Vector3 eye_of(const Camera& camera) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  return -camera_from_world.leftCols<3>().transpose() * camera_from_world.col(3);
}

}  // namespace

ModelRays::ModelRays(const Camera& camera, const RayModel& model, double sample_error)
    : camera_(moved(camera, as_vector(model.shift))),
      rotation_error_(model.rotation_error),
      sample_error_(sample_error),
      rays_(camera_rays(camera_)),
      eye_(eye_of(camera_)) {}

double ModelRays::tilt(const Vector3& v) const {
  return rotation_error_ * std::sqrt(3 * v.squaredNorm());
}

/// Each part of a ray is a sum of three terms, two of them products with a rounded factor and a
/// rounded position; a sample that lies elsewhere in the pixel moves it by its derivatives.
Ray ModelRays::through(double x, double y) const {
  Ray ray;
  const auto part = [&](const CameraRays::Affine& f, Vector3& value, Vector3& error) {
    const Vector3 at_corner = as_vector(f.at_corner), per_u = as_vector(f.per_u),
                  per_v = as_vector(f.per_v);
    value = at_corner + x * per_u + y * per_v;
    error = 4 * u * (abs(at_corner) + abs(x * per_u) + abs(y * per_v)) +
            sample_error_ * (abs(per_u) + abs(per_v));
  };
  part(rays_.origin, ray.origin, ray.origin_error);
  part(rays_.direction, ray.direction, ray.direction_error);
  ray.origin_error.array() += tilt(ray.origin - eye_);
  ray.direction_error.array() += tilt(ray.direction);
  return ray;
}

double ModelRays::depth_error(const Ray& ray, double t) const {
  const Eigen::Map<const Eigen::Vector4d> row(camera_.world_to_camera[2].data());
  const Vector3 along = t * ray.direction;
  const double terms = abs(row.head<3>()).dot(abs(ray.origin) + 2 * abs(along)) + std::abs(row.w());
  return 8 * u * terms + tilt(ray.origin + along - eye_);
}

// docs/validation.md, "A ray tracer", derives how a triangle is seen, in the same order.

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A triangle seen from the ray's origin.
struct Seen {
  /// Corners from the origin, and how far the renderer's own are off.
  std::array<Vector3, 3> corners, held;
  Vector3 e1, e2, normal;
  /// N·d, and the sum of the bounds of the edge tests.
  double facing = 0, facing_error = 0;
  /// The part of it that roundings of the renderer's own ray are.
  double facing_rounded = 0;
};

Seen seen_from(const Ray& ray, const std::array<Vector3, 3>& corners) {
  Seen seen;
  for (std::size_t i = 0; i < 3; ++i) {
    seen.corners[i] = corners[i] - ray.origin;
    seen.held[i] = u * abs(corners[i]) + ray.origin_error + u * abs(seen.corners[i]);
  }
  seen.e1 = seen.corners[1] - seen.corners[0];
  seen.e2 = seen.corners[2] - seen.corners[0];
  seen.normal = seen.e1.cross(seen.e2);
  seen.facing = seen.normal.dot(ray.direction);
  return seen;
}

/// The volumes of two corners and the ray, one for each edge, and their bounds without the common
/// part: `rounded`, the roundings of all three. Whether a volume is computed by differences with
/// one corner or by sums of two, its roundings are at most the model's roundings of these products.
struct EdgeTests {
  std::array<double, 3> volume{}, error{};
  double rounded = 0;
};

EdgeTests edge_tests(const Seen& seen, const Ray& ray, const RayModel& model) {
  const auto& a = seen.corners;
  const auto& held = seen.held;
  const Vector3& d = ray.direction;
  EdgeTests tests;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    tests.volume[k] = a[i].cross(a[j]).dot(d);
    tests.error[k] = abs(a[i].cross(a[j])).dot(ray.direction_error) +
                     held[i].dot(abs(a[j].cross(d))) + held[j].dot(abs(d.cross(a[i]))) +
                     2 * (permanent(held[i], held[j], abs(d) + ray.direction_error));
    tests.rounded += model.roundings * u *
                     permanent(a[j] - a[i], abs(a[i]) + abs(a[j]), abs(d) + ray.direction_error);
  }
  return tests;
}

/// Coverage, open edges and inside; nothing where the ray is certain to pass by.
std::optional<Fragment> covered(Seen& seen, const Ray& ray, const RayModel& model) {
  const EdgeTests tests = edge_tests(seen, ray, model);
  const bool turned = seen.facing < 0;
  Fragment f{.coverage = Coverage::must, .turned = turned, .inside = true};
  seen.facing_rounded = 3 * own_roundings * tests.rounded;
  bool one_way = true, other_way = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const double bound = own_roundings * (tests.error[k] + tests.rounded);
    seen.facing_error += bound;
    one_way = one_way && tests.volume[k] + bound >= 0;
    other_way = other_way && tests.volume[k] - bound <= 0;
    const double inward = turned ? -tests.volume[k] : tests.volume[k];
    if (inward < 0) f.inside = false;
    if (!(inward > bound)) {
      f.coverage = Coverage::may;
      f.open_edges |= static_cast<std::uint8_t>(1U << k);
    }
  }
  if (!one_way && !other_way) return std::nullopt;
  return f;
}

/// The error of a distance that is computed from the point at rounded weights of the corners. They
/// are the weights of the renderer's own ray, up to `weight_error`.
double distance_error(const Seen& seen, double weight_error) {
  const double longest = std::max({seen.e1.norm(), seen.e2.norm(), (seen.e2 - seen.e1).norm()});
  const double size =
      std::max({seen.corners[0].norm(), seen.corners[1].norm(), seen.corners[2].norm()});
  return 2 * own_roundings * weight_error * longest + 16 * u * size;
}

/// The distance: N·(corner − origin) / N·d, of a plane whose corners are displaced.
void set_value(Fragment& f, const Seen& seen, const Ray& ray, const ModelRays& rays,
               const RayModel& model) {
  const auto& [a, held, e1, e2, normal, facing, facing_error, facing_rounded] = seen;
  const double t = normal.dot(a[0]) / facing;
  const double rest = std::abs(facing) - facing_error;
  const Vector3 displaced = held[0].cwiseMax(held[1]).cwiseMax(held[2]);
  const Vector3 spread = displaced + std::abs(t) * ray.direction_error;
  const double plane_error =
      model.roundings * u *
      (permanent(e1, e2, a[0]) + std::abs(t) * permanent(e1, e2, ray.direction));
  // Weights of a sample that an open edge lets in may be negative, by the edges' bounds in all.
  const double outside = 1 + 2 * facing_error / rest;
  double half = own_roundings * outside * (abs(normal).dot(spread) + plane_error) / rest;
  if (!(rest > 0) || !std::isfinite(t)) {
    f.coverage = Coverage::may;
    half = infinity;
  }
  half += 2 * u * std::abs(t);
  if (model.rays) {
    half = half * ray.length + (std::abs(t) + half) * ray.direction_error.norm();
    if (model.depth_from_point) half += distance_error(seen, facing_rounded / rest);
  } else if (model.depth_from_point) {
    half += rays.depth_error(ray, t);
  }
  if (std::isnan(half)) half = infinity;
  f.exact = std::isfinite(t) ? t * ray.length : 0;
  f.value = {f.exact - half, f.exact + half};
}

/// A triangle at a ray: how a renderer of the model may see it, between near and far of the camera.
/// Nothing where it is certain not to.
///
/// Frame    corners in the moved world of `rays`. The fragment's values are depths.
std::optional<Fragment> ray_on_triangle(const std::array<Vector3, 3>& corners, const Ray& ray,
                                        const ModelRays& rays, const RayModel& model) {
  Seen seen = seen_from(ray, corners);
  std::optional<Fragment> f = covered(seen, ray, model);
  if (!f) return std::nullopt;
  set_value(*f, seen, ray, rays, model);
  const Camera& camera = rays.camera();
  if (f->value.upper <= 0 || f->value.upper < camera.near || f->value.lower > camera.far) {
    return std::nullopt;
  }
  if (f->value.lower <= 0 || f->value.lower < camera.near || f->value.upper > camera.far) {
    f->coverage = Coverage::may;
    f->open_edges = joins_no_other;
  }
  return f;
}

/// A corner in the camera frame, and the greatest of the terms that its coordinates are sums of.
struct CameraCorner {
  Vector3 position;
  double size;
};

CameraCorner in_camera(const Camera& camera, const Vector3& p) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Eigen::Matrix<double, 3, 4> terms = camera_from_world * p.homogeneous().eval().asDiagonal();
  return {terms.rowwise().sum(), terms.cwiseAbs().maxCoeff()};
}

/// A cone from the origin: all directions within an angle of an axis.
struct Cone {
  Vector3 axis{0, 0, 0};
  /// π or more: all directions. Negative: none.
  double angle = -1;
};

constexpr double all_directions = std::numbers::pi;
/// Far more than corners, origins and computed angles err by.
constexpr double cone_margin = 1e-5;

/// The angle between two directions, up to 10⁻⁷.
double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Contains the directions of a set of rays, and how far their errors turn them.
Cone cone_around(const std::vector<const PixelRays::PixelRay*>& rays) {
  Cone cone;
  for (const auto* ray : rays) cone.axis += as_vector(ray->direction).normalized();
  if (!rays.empty() && cone.axis.norm() < 0x1p-10)
    return {.axis = {0, 0, 1}, .angle = all_directions};
  for (const auto* ray : rays) {
    const Vector3 direction = as_vector(ray->direction);
    const double turn = as_vector(ray->error).norm() / direction.norm();
    // asin(x) <= πx/2
    const double angle = angle_between(cone.axis, direction) + std::numbers::pi / 2 * turn;
    cone.angle = std::max(cone.angle, turn < 1 ? angle : all_directions);
  }
  return cone;
}

/// Contains a triangle.
Cone cone_around(const std::array<Vector3, 3>& corners) {
  Cone cone{.axis = (corners[0] + corners[1] + corners[2]) / 3};
  double radius = 0;
  for (const Vector3& corner : corners) radius = std::max(radius, (corner - cone.axis).norm());
  const double sine = radius / cone.axis.norm();
  cone.angle = sine < 0.99 ? std::asin(sine) : all_directions;
  return cone;
}

/// Rays that a model gives pixel by pixel.
class GivenRays {
 public:
  GivenRays(const Camera& camera, std::shared_ptr<const PixelRays> rays)
      : width_(camera.width), squares_(camera), rays_(std::move(rays)) {
    if (!rays_) return;
    for (std::size_t square = 0; square < squares_.count(); ++square)
      cones_.push_back(cone_of(squares_.pixels(square)));
  }

  /// nullopt where no ray is shot.
  [[nodiscard]] std::optional<Ray> at(std::uint32_t column, std::uint32_t row) const {
    const PixelRays::PixelRay& given = given_at(column, row);
    Ray ray{.origin = Vector3::Zero(),
            .direction = as_vector(given.direction),
            .origin_error = Vector3::Constant(rays_->origin_error),
            .direction_error = as_vector(given.error)};
    ray.length = ray.direction.norm();
    if (ray.length == 0) return std::nullopt;
    return ray;
  }

  /// Whether the ray of a pixel may meet a triangle in the cone.
  /// Exact    |cos(a + b) − cos a| ≤ b.
  [[nodiscard]] bool may_meet(std::uint32_t column, std::uint32_t row, const Cone& cone) const {
    if (cone.angle >= all_directions) return true;
    const PixelRays::PixelRay& ray = given_at(column, row);
    const Vector3 direction = as_vector(ray.direction);
    const double turned = std::numbers::pi / 2 * as_vector(ray.error).norm();
    const double room = turned + cone_margin * direction.norm();
    return direction.dot(cone.axis) >=
           (std::cos(cone.angle) * direction.norm() - room) * cone.axis.norm();
  }

  /// The pixels whose rays may meet a triangle.
  [[nodiscard]] PixelBox pixels_of(const std::array<Vector3, 3>& corners) const {
    const Cone cone = cone_around(corners);
    return squares_.around([&](std::size_t square) {
      const Cone& rays = cones_[square];
      if (rays.angle < 0) return false;
      const double reach = rays.angle + cone.angle + cone_margin;
      return reach >= all_directions || angle_between(rays.axis, cone.axis) <= reach;
    });
  }

 private:
  [[nodiscard]] const PixelRays::PixelRay& given_at(std::uint32_t column, std::uint32_t row) const {
    return rays_->rays[std::size_t{row} * width_ + column];
  }
  [[nodiscard]] Cone cone_of(const PixelBox& pixels) const {
    std::vector<const PixelRays::PixelRay*> rays;
    for (std::uint32_t row = pixels.first_row; row <= pixels.last_row; ++row) {
      for (std::uint32_t column = pixels.first_column; column <= pixels.last_column; ++column) {
        const auto& ray = given_at(column, row);
        if (ray.direction != std::array<double, 3>{}) rays.push_back(&ray);
      }
    }
    return cone_around(rays);
  }

  std::uint32_t width_;
  PixelSquares squares_;
  std::shared_ptr<const PixelRays> rays_;
  std::vector<Cone> cones_;
};

class RayFragments final : public FragmentSource {
 public:
  RayFragments(const WorldMesh& mesh, const Camera& camera, const SamplePosition& sample,
               const RayModel& model)
      : mesh_(mesh),
        sample_(sample),
        grid_(camera, sample),
        model_(model),
        rays_(camera, model, sample.error),
        given_(camera, model.rays) {}

  [[nodiscard]] PixelBox box(std::uint32_t triangle) const override;
  void each(std::uint32_t triangle, const PixelBox& box, const TakeFragment& take) const override;

 private:
  [[nodiscard]] std::array<Vector3, 3> corners(std::uint32_t triangle) const {
    const CornerIndices& t = mesh_.triangles[triangle];
    const Vector3 shift = as_vector(model_.shift);
    return {as_vector(mesh_.points[t[0]]) - shift, as_vector(mesh_.points[t[1]]) - shift,
            as_vector(mesh_.points[t[2]]) - shift};
  }

  /// nullopt where no ray is shot.
  [[nodiscard]] std::optional<Ray> ray_of(std::uint32_t column, std::uint32_t row) const {
    if (model_.rays) return given_.at(column, row);
    const auto [x, y] = grid_.at(column, row);
    if (std::isnan(x)) return std::nullopt;
    return rays_.through(x, y);
  }

  const WorldMesh& mesh_;
  SamplePosition sample_;
  SampleGrid grid_;
  RayModel model_;
  ModelRays rays_;
  GivenRays given_;
};

PixelBox RayFragments::box(std::uint32_t triangle) const {
  if (model_.rays) return given_.pixels_of(corners(triangle));
  const Camera& c = rays_.camera();
  const auto [cx, cy] = principal_point(c.projection);
  ImageBox box;
  bool before = false, behind = false;
  for (const Vector3& p : corners(triangle)) {
    const auto [q, size] = in_camera(c, p);
    const double w = is_perspective(c.projection) ? q[2] : 1;
    if (q[2] < 64 * u * size) {
      behind = true;
      continue;
    }
    before = true;
    const double x = (c.projection.fx * q[0] + c.projection.skew * q[1]) / w + cx,
                 y = c.projection.fy * q[1] / w + cy;
    // displaced corners: 64u of the coordinates that the position is the sum of
    const double margin = (64 * u + 8 * model_.rotation_error) * size / w *
                              (std::abs(c.projection.fx) + std::abs(c.projection.fy) +
                               std::abs(c.projection.skew) + std::abs(x - cx) + std::abs(y - cy)) +
                          sample_.error + 1 + grid_.reach();
    box.add(x, y, margin, margin);
  }
  if (!before) return {};
  if (behind) return whole_image(c);
  return sample_.lens ? sample_.lens->pixels_of(box) : pixels_of(box, c, 0);
}

void RayFragments::each(std::uint32_t triangle, const PixelBox& box,
                        const TakeFragment& take) const {
  if (box.is_empty()) return;
  const std::array<Vector3, 3> points = corners(triangle);
  const Cone cone = model_.rays ? cone_around(points) : Cone{.angle = all_directions};
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
      if (model_.rays && !given_.may_meet(column, row, cone)) continue;
      const std::optional<Ray> ray = ray_of(column, row);
      if (!ray) continue;
      std::optional<Fragment> f = ray_on_triangle(points, *ray, rays_, model_);
      if (!f) continue;
      f->triangle = triangle;
      take(column, row, *f);
    }
  }
}

}  // namespace

std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const SamplePosition& sample, const RayModel& model) {
  return std::make_unique<RayFragments>(mesh, camera, sample, model);
}

}  // namespace fathom::attribution
