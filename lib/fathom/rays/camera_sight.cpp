#include "fathom/rays/camera_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/ratio.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/rays/walk_ray.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::rays {
namespace {

CertifiedNumber exactly(double value) {
  return {value, 0};
}

std::optional<Sign> sign_of(const CertifiedNumber& x) {
  if (x.value > x.error) return Sign::positive;
  if (-x.value > x.error) return Sign::negative;
  if (x.value == 0 && x.error == 0) return Sign::zero;
  return std::nullopt;
}

CertifiedNumber determinant(const std::array<CertifiedNumber, 3>& a,
                            const std::array<CertifiedNumber, 3>& b,
                            const std::array<CertifiedNumber, 3>& c) {
  return a[0] * minus(b[1] * c[2], b[2] * c[1]) + a[1] * minus(b[2] * c[0], b[0] * c[2]) +
         a[2] * minus(b[0] * c[1], b[1] * c[0]);
}

ExactVector3 to_vector(const HomogeneousImagePoint& p) {
  return {p.U, p.V, p.W};
}

/// A number that has been rounded once to nearest.
CertifiedNumber rounded_once(double x, long power) {
  const CertifiedNumber number = number_in_unit(x, power);
  return {number.value, number.error + 2 * unit_roundoff<double> * std::abs(number.value)};
}

}  // namespace

/// The visitor of a walk from a point to the end of its sight, where the depth is 0: the camera or,
/// for an orthographic camera, a point next to it.
class CameraSight::HidingTriangle final : public TriangleVisitor {
 public:
  /// `ends_at_0`: whether the walk's segment ends where the depth is 0.
  HidingTriangle(const CameraSight& sight, const SightEnd& p, const View& view, const WalkRay& ray,
                 bool ends_at_0)
      : sight_(sight), p_(p), view_(view), ray_(ray) {
    set_last(ray.last);
    if (ends_at_0) in_range_before_ = ray.segment_last.lower * share_in_range();
  }

  bool offer(const TestedTriangle& triangle) override {
    if (triangle.number == p_.triangle()) return false;
    const Interval s = triangle.s();
    if (s.upper < ray_.segment_first.lower || s.lower > ray_.segment_last.upper) return false;
    // It is between the point and the camera, and beyond the near limit. n·d has the sign of −Δ
    // where det R is positive: the ray goes to the camera.
    if (triangle.is_met && s.lower > ray_.segment_first.upper && s.upper < in_range_before_) {
      const Sign side = triangle.w < 0 ? Sign::negative : Sign::positive;
      is_found_ = sight_.is_kept(-side * sight_.rotation_);
    } else {
      is_found_ = sight_.hides(triangle, p_, view_);
    }
    return is_found_;
  }
  [[nodiscard]] bool is_found() const { return is_found_; }

 private:
  /// The depth falls from D to 0 evenly: it is at least near on this share of the way, or on more.
  [[nodiscard]] double share_in_range() const {
    if (sight_.camera_.near == 0) return 1;
    const double least_depth = view_.z.value - view_.z.error;
    const double greatest_near = sight_.near_.value + sight_.near_.error;
    // Rounded three times: less is always right.
    constexpr double less = 1 - 0x1p-50;
    return least_depth > 0 ? (1 - greatest_near / least_depth / less) * less : 0;
  }

  const CameraSight& sight_;
  const SightEnd& p_;
  const View& view_;
  const WalkRay& ray_;
  /// A triangle that is met before this s is in the camera's range.
  double in_range_before_ = 0;
  bool is_found_ = false;
};

CameraSight::CameraSight(const RayScene& scene, const Camera& camera, Cull cull)
    : scene_(scene), camera_(camera), cull_(cull) {
  const long power = scene.tree().power();
  const Pose& pose = camera.world_to_camera;
  std::array<ExactVector3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      pose_[i][k] = exactly(pose[i][k]);
      rows[i][k] = pose[i][k];
    }
    pose_[i][3] = number_in_unit(pose[i][3], power);
  }
  cofactors_ = cofactors(rows);
  rotation_ = determinant_of_rotation(pose).sign();
  near_ = number_in_unit(camera.near, power);
  one_ = number_in_unit(1, power);
  lens_ = is_mirrored(camera.projection) ? Sign::negative : Sign::positive;
  const Pose inverse = camera_to_world(pose);
  for (std::size_t k = 0; k < 3; ++k) {
    eye_[k] = is_perspective(camera.projection) ? rounded_once(inverse[k][3], power)
                                                : rounded_once(-inverse[k][2], 0);
  }
}

CameraSight::View CameraSight::view_of(const CertifiedVector& p) const {
  const auto row = [&](std::size_t i) {
    CertifiedNumber sum = pose_[i][3];
    for (std::size_t k = 0; k < 3; ++k) sum = sum + pose_[i][k] * p[k];
    return sum;
  };
  return {row(0), row(1), row(2)};
}

CameraSight::Image CameraSight::image_of(const View& view) const {
  const bool perspective = is_perspective(camera_.projection);
  return {view.x, view.y, perspective ? view.z : one_};
}

bool CameraSight::is_kept(Sign turn) const {
  const Sign facing = turn * lens_;
  return cull_ == Cull::none ||
         (cull_ == Cull::back ? facing == Sign::negative : facing == Sign::positive);
}

/// Whether a triangle is neither seen edge on nor culled.
bool CameraSight::shows_a_side(std::uint32_t triangle) const {
  const TriangleSource& source = scene_.triangles();
  const auto corners = corners_in_unit(source, triangle, scene_.tree().power());
  std::array<Image, 3> images;
  for (std::size_t i = 0; i < 3; ++i) images[i] = image_of(view_of(corners[i]));
  const auto turn = sign_of(determinant(images[0], images[1], images[2]));
  if (turn) return *turn != Sign::zero && is_kept(*turn);
  TierCounts counts;
  const auto projected =
      triangle::project(source.world_corners(triangle), triangle, camera_, counts);
  return projected.orientation != Sign::zero && triangle::is_kept(projected, cull_);
}

bool CameraSight::is_in_range(const SightEnd& p, const View& view) const {
  const auto in_front = sign_of(view.z), beyond_near = sign_of(minus(view.z, near_));
  if (in_front == Sign::negative || beyond_near == Sign::negative) return false;
  if (in_front == Sign::positive && beyond_near == Sign::positive && std::isinf(camera_.far))
    return true;
  const Dyadic depth = to_camera(camera_.world_to_camera, p.exact(scene_.triangles())).z;
  return depth.sign() == Sign::positive && depth >= Dyadic(camera_.near) &&
         (std::isinf(camera_.far) || depth <= Dyadic(camera_.far));
}

bool CameraSight::is_in_image(const SightEnd& p, const View& view) const {
  const auto& [x, y, W] = image_of(view);
  const CertifiedNumber half_less_centre = exactly(0.5) + exactly(-camera_.projection.pixel_centre);
  const auto centred = [&](double c) { return exactly(c) + half_less_centre; };
  const CertifiedNumber u = exactly(camera_.projection.fx) * x +
                            exactly(camera_.projection.skew) * y +
                            centred(camera_.projection.cx) * W;
  const CertifiedNumber v = exactly(camera_.projection.fy) * y + centred(camera_.projection.cy) * W;
  bool certain = true;
  for (const CertifiedNumber& inside :
       {u, minus(exactly(camera_.width) * W, u), v, minus(exactly(camera_.height) * W, v)}) {
    const auto sign = sign_of(inside);
    if (sign == Sign::negative) return false;
    certain = certain && sign;
  }
  if (certain) return true;
  const auto [U, V, exact_W] =
      to_image(camera_.projection, to_camera(camera_.world_to_camera, p.exact(scene_.triangles())));
  return U.sign() != Sign::negative && V.sign() != Sign::negative &&
         U <= exact_W * Dyadic(camera_.width) && V <= exact_W * Dyadic(camera_.height);
}

/// With λ = w/Δ the point's image is Σ λᵢ·qᵢ of the corners' images q, and the plane of the
/// triangle has the depth Σ wᵢ·Dᵢ / Σ wᵢ there. Nothing where a sign is not settled or zero.
std::optional<bool> CameraSight::hides_certainly(const TestedTriangle& triangle,
                                                 const View& view) const {
  const RayTree& tree = scene_.tree();
  const auto places = tree.corners(triangle.place);
  const double error = tree.corner_error() + most_underflow;
  std::array<View, 3> corners;
  std::array<Image, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = view_of({{{places[i][0], error}, {places[i][1], error}, {places[i][2], error}}});
    q[i] = image_of(corners[i]);
  }
  const Image p = image_of(view);
  std::array<CertifiedNumber, 3> w;
  std::array<std::optional<Sign>, 3> signs;
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = determinant(p, q[(i + 1) % 3], q[(i + 2) % 3]);
    signs[i] = sign_of(w[i]);
    for (std::size_t k = 0; k < i; ++k)
      if (signs[i] && signs[k] && *signs[i] * *signs[k] == Sign::negative) return false;
  }
  if (signs[0] == std::nullopt || signs[0] == Sign::zero || signs[1] != signs[0] ||
      signs[2] != signs[0])
    return std::nullopt;
  const Sign turn = *signs[0];
  const auto depth_less = [&](const CertifiedNumber& depth) -> std::optional<Sign> {
    CertifiedNumber sum = exactly(0);
    for (std::size_t i = 0; i < 3; ++i) sum = sum + w[i] * minus(corners[i].z, depth);
    const auto sign = sign_of(sum);
    return sign ? std::optional(*sign * turn) : std::nullopt;
  };
  const auto in_front = depth_less(exactly(0)), nearer = depth_less(view.z);
  if (in_front == Sign::negative || nearer == Sign::positive) return false;
  if (in_front != Sign::positive || nearer != Sign::negative) return std::nullopt;
  const auto beyond_near = depth_less(near_);
  if (!beyond_near || *beyond_near == Sign::zero) return std::nullopt;
  return *beyond_near == Sign::positive && is_kept(turn);
}

bool CameraSight::hides_exactly(std::uint32_t number, const SightEnd& p) const {
  TierCounts counts;
  const TriangleSource& source = scene_.triangles();
  const triangle::ProjectedTriangle t =
      triangle::project(source.world_corners(number), number, camera_, counts);
  if (t.orientation == Sign::zero || !triangle::is_kept(t, cull_)) return false;
  const CameraPoint at = to_camera(camera_.world_to_camera, p.exact(source));
  const ExactVector3 q = to_vector(to_image(camera_.projection, at));
  for (const LinearForm& edge : t.edges)
    if (dot(edge.coefficients(), q).sign() == Sign::negative) return false;
  const Ratio depth(dot(t.depth_numerator.coefficients(), q), dot(t.weight.coefficients(), q));
  return depth.sign() == Sign::positive && !(depth < Ratio(Dyadic(camera_.near))) &&
         depth < Ratio(at.z);
}

bool CameraSight::hides(const TestedTriangle& triangle, const SightEnd& p, const View& view) const {
  const auto certain = hides_certainly(triangle, view);
  return certain ? *certain : hides_exactly(triangle.number, p);
}

/// Where the depth is 0 on the line of sight.
CertifiedVector CameraSight::end_of_sight(const SightEnd& p, const View& view) const {
  if (is_perspective(camera_.projection)) return eye_;
  CertifiedVector end;
  for (std::size_t k = 0; k < 3; ++k) end[k] = p.near()[k] + view.z * eye_[k];
  return end;
}

/// The ray from the point along the line of sight. The direction from the point to the camera is
/// −R⁻¹·x for a point with depth above 0, where x are its coordinates in the camera's frame; for an
/// orthographic camera it is −R⁻¹·(0, 0, 1). Here it is │det R│ times as long.
ExactRay CameraSight::exact_ray(const SightEnd& p) const {
  const WorldPoint from = p.exact(scene_.triangles());
  ExactVector3 x{0.0, 0.0, 1.0};
  if (is_perspective(camera_.projection)) {
    const CameraPoint at = to_camera(camera_.world_to_camera, from);
    x = {at.x, at.y, at.z};
  }
  ExactVector3 way;
  for (std::size_t k = 0; k < 3; ++k) {
    const Dyadic sum = cofactors_[0][k] * x[0] + cofactors_[1][k] * x[1] + cofactors_[2][k] * x[2];
    way[k] = rotation_ == Sign::positive ? -sum : sum;
  }
  return {{from.x, from.y, from.z}, way};
}

bool CameraSight::is_hidden(const SightEnd& p, const View& view) const {
  const auto certified = prepare_between(p.near(), end_of_sight(p, view));
  const auto ray = certified ? certified : prepare(exact_ray(p), {}, scene_.tree());
  if (!ray) return false;
  HidingTriangle hiding(*this, p, view, *ray, certified.has_value());
  walk(scene_.tree(), *ray, hiding);
  return hiding.is_found();
}

bool CameraSight::sees(const SightEnd& p) const {
  const View view = view_of(p.near());
  return is_in_range(p, view) && is_in_image(p, view) &&
         (p.triangle() == no_triangle || shows_a_side(p.triangle())) && !is_hidden(p, view);
}

}  // namespace fathom::rays
