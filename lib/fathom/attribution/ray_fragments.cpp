#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/attribution/camera_rays.h"
#include "fathom/attribution/fragment_source.h"

// docs/validation.md, "A ray tracer", derives what stands here, in the same order.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff;
constexpr double infinity = std::numeric_limits<double>::infinity();

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vector operator*(double s, const Vector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector abs(const Vector& a) {
  return {std::abs(a[0]), std::abs(a[1]), std::abs(a[2])};
}

/// det(a, b, c) with every product taken absolutely: what roundings of a determinant are relative
/// to.
double permanent(const Vector& a, const Vector& b, const Vector& c) {
  const Vector p = abs(a), q = abs(b), r = abs(c);
  return p[0] * (q[1] * r[2] + q[2] * r[1]) + p[1] * (q[2] * r[0] + q[0] * r[2]) +
         p[2] * (q[0] * r[1] + q[1] * r[0]);
}

/// A ray origin + t·direction, t the depth, and how far the renderer's own may be from it.
struct Ray {
  Vector origin{}, direction{}, origin_error{}, direction_error{};
};

/// The camera in a world whose origin is `shift`.
Camera moved(Camera camera, const Vector& shift) {
  for (auto& row : camera.world_to_camera) {
    row[3] += row[0] * shift[0] + row[1] * shift[1] + row[2] * shift[2];
  }
  return camera;
}

/// −Rᵀt; used where R is a rotation.
Vector eye_of(const Camera& camera) {
  Vector eye{};
  for (const auto& row : camera.world_to_camera) {
    for (std::size_t k = 0; k < 3; ++k) eye[k] -= row[k] * row[3];
  }
  return eye;
}

class RayFragments final : public FragmentSource {
 public:
  RayFragments(const WorldMesh& mesh, const Camera& camera, const RendererModel& model)
      : mesh_(mesh),
        camera_(moved(camera, model.shift)),
        model_(model),
        rays_(camera_rays(camera_)),
        eye_(eye_of(camera_)) {}

  [[nodiscard]] PixelBox box(std::uint32_t triangle) const override;
  void each(std::uint32_t triangle, const PixelBox& box, const TakeFragment& take) const override;

 private:
  [[nodiscard]] Ray ray(double x, double y) const;
  [[nodiscard]] std::optional<Fragment> on(const std::array<Vector, 3>& corners,
                                           const Ray& ray) const;
  [[nodiscard]] std::array<Vector, 3> corners(std::uint32_t triangle) const {
    const CornerIndices& t = mesh_.triangles[triangle];
    return {mesh_.points[t[0]] - model_.shift, mesh_.points[t[1]] - model_.shift,
            mesh_.points[t[2]] - model_.shift};
  }

  const WorldMesh& mesh_;
  Camera camera_;
  RendererModel model_;
  /// What the rotation's error makes of a vector: a component is a row, off by at most
  /// rotation_error in each of its entries, times a vector of this length.
  [[nodiscard]] double tilt(const Vector& v) const {
    return model_.rotation_error * std::sqrt(3 * dot(v, v));
  }

  CameraRays rays_;
  Vector eye_;
};

/// Each part of a ray is a sum of three terms, two of them products with a rounded factor and a
/// rounded position; a sample that lies elsewhere in the pixel moves it by its derivatives.
Ray RayFragments::ray(double x, double y) const {
  Ray ray;
  const auto part = [&](const CameraRays::Affine& f, Vector& value, Vector& error) {
    for (std::size_t k = 0; k < 3; ++k) {
      value[k] = f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k];
      error[k] =
          4 * u * (std::abs(f.at_corner[k]) + std::abs(x * f.per_u[k]) + std::abs(y * f.per_v[k])) +
          model_.sample_error * (std::abs(f.per_u[k]) + std::abs(f.per_v[k]));
    }
  };
  part(rays_.origin, ray.origin, ray.origin_error);
  part(rays_.direction, ray.direction, ray.direction_error);
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin_error[k] += tilt(ray.origin - eye_);
    ray.direction_error[k] += tilt(ray.direction);
  }
  return ray;
}

PixelBox RayFragments::box(std::uint32_t triangle) const {
  const Camera& c = camera_;
  const double cx = c.cx + (0.5 - c.pixel_centre), cy = c.cy + (0.5 - c.pixel_centre);
  double least_x = infinity, least_y = infinity, greatest_x = -infinity, greatest_y = -infinity;
  bool before = false, behind = false;
  for (const Vector& p : corners(triangle)) {
    std::array<double, 3> q{};
    double size = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const auto& m = c.world_to_camera[r];
      q[r] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
      size = std::max({size, std::abs(m[0] * p[0]), std::abs(m[1] * p[1]), std::abs(m[2] * p[2]),
                       std::abs(m[3])});
    }
    const double w = c.projection == Projection::perspective ? q[2] : 1;
    if (q[2] < 64 * u * size) {
      behind = true;
      continue;
    }
    before = true;
    const double x = (c.fx * q[0] + c.skew * q[1]) / w + cx, y = c.fy * q[1] / w + cy;
    // displaced corners: 64u of the coordinates that the position is the sum of
    const double margin = (64 * u + 8 * model_.rotation_error) * size / w *
                              (std::abs(c.fx) + std::abs(c.fy) + std::abs(c.skew) +
                               std::abs(x - cx) + std::abs(y - cy)) +
                          model_.sample_error + 1;
    least_x = std::min(least_x, x - margin);
    greatest_x = std::max(greatest_x, x + margin);
    least_y = std::min(least_y, y - margin);
    greatest_y = std::max(greatest_y, y + margin);
  }
  if (!before) return {};
  const double last_x = c.width - 1.0, last_y = c.height - 1.0;
  if (behind) return {0, c.width - 1, 0, c.height - 1};
  if (!(least_x <= last_x) || !(least_y <= last_y) || greatest_x < 0 || greatest_y < 0) return {};
  const auto clamped = [](double x, double last) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(x), 0.0, last));
  };
  return {clamped(least_x, last_x), clamped(greatest_x, last_x), clamped(least_y, last_y),
          clamped(greatest_y, last_y)};
}

std::optional<Fragment> RayFragments::on(const std::array<Vector, 3>& corners,
                                         const Ray& ray) const {
  std::array<Vector, 3> a, held;  // corners from the origin, and how far the renderer's own are off
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = corners[i] - ray.origin;
    held[i] = u * abs(corners[i]) + ray.origin_error + u * abs(a[i]);
  }
  const Vector& d = ray.direction;
  const Vector e1 = a[1] - a[0], e2 = a[2] - a[0];
  const Vector normal = cross(e1, e2);
  const double facing = dot(normal, d);
  const bool turned = facing < 0;

  // Edge tests: volumes of corners and ray. Each in whichever way it is computed, by differences
  // with one corner or by sums of two, takes no more than ray_roundings roundings of these
  // products.
  std::array<double, 3> volume{}, error{};
  double rounded = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    volume[k] = dot(cross(a[i], a[j]), d);
    error[k] = dot(abs(cross(a[i], a[j])), ray.direction_error) +
               dot(held[i], abs(cross(a[j], d))) + dot(held[j], abs(cross(d, a[i]))) +
               2 * (permanent(held[i], held[j], abs(d) + ray.direction_error));
    rounded += model_.ray_roundings * u *
               permanent(a[j] - a[i], abs(a[i]) + abs(a[j]), abs(d) + ray.direction_error);
  }
  Fragment f{.coverage = Coverage::must, .turned = turned, .inside = true};
  bool one_way = true, other_way = true;
  double facing_error = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double bound = own_roundings * (error[k] + rounded);
    facing_error += bound;
    one_way = one_way && volume[k] + bound >= 0;
    other_way = other_way && volume[k] - bound <= 0;
    const double inward = turned ? -volume[k] : volume[k];
    if (inward < 0) f.inside = false;
    if (!(inward > bound)) {
      f.coverage = Coverage::may;
      f.open_edges |= static_cast<std::uint8_t>(1U << k);
    }
  }
  if (!one_way && !other_way) return std::nullopt;

  // The distance: N·(corner − origin) / N·d, of a plane whose corners are displaced.
  const double t = dot(normal, a[0]) / facing;
  const double rest = std::abs(facing) - facing_error;
  Vector displaced = held[0];
  for (std::size_t k = 0; k < 3; ++k) displaced[k] = std::max({held[0][k], held[1][k], held[2][k]});
  const Vector spread = displaced + std::abs(t) * ray.direction_error;
  const double plane_error =
      model_.ray_roundings * u * (permanent(e1, e2, a[0]) + std::abs(t) * permanent(e1, e2, d));
  // Weights of a sample that an open edge lets in may be negative, by the edges' bounds in all.
  const double outside = 1 + 2 * facing_error / rest;
  double half = own_roundings * outside * (dot(abs(normal), spread) + plane_error) / rest;
  if (!(rest > 0) || !std::isfinite(t)) {
    f.coverage = Coverage::may;
    half = infinity;
  }
  half += 2 * u * std::abs(t);
  if (model_.depth_from_point) {
    const auto& m = camera_.world_to_camera[2];
    double terms = std::abs(m[3]);
    for (std::size_t k = 0; k < 3; ++k) {
      terms += std::abs(m[k]) * (std::abs(ray.origin[k]) + 2 * std::abs(t * d[k]));
    }
    half += 8 * u * terms + tilt(ray.origin + t * d - eye_);
  }
  if (std::isnan(half)) half = infinity;
  f.exact = std::isfinite(t) ? t : 0;
  f.value = {f.exact - half, f.exact + half};
  if (f.value.upper <= 0 || f.value.upper < camera_.near || f.value.lower > camera_.far) {
    return std::nullopt;
  }
  if (f.value.lower <= 0 || f.value.lower < camera_.near || f.value.upper > camera_.far) {
    f.coverage = Coverage::may;
    f.open_edges = joins_no_other;
  }
  return f;
}

void RayFragments::each(std::uint32_t triangle, const PixelBox& box,
                        const TakeFragment& take) const {
  if (box.is_empty()) return;
  const std::array<Vector, 3> points = corners(triangle);
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
      std::optional<Fragment> f =
          on(points, ray(column + model_.sample[0], row + model_.sample[1]));
      if (!f) continue;
      f->triangle = triangle;
      take(column, row, *f);
    }
  }
}

}  // namespace

std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const RendererModel& model) {
  return std::make_unique<RayFragments>(mesh, camera, model);
}

}  // namespace fathom::attribution
