#include "fathom/evaluation/point_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fathom/evaluation/bounds.h"
#include "fathom/numeric/ratio.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::evaluation {
namespace {

using Number = Certified<double>;

Number exactly(double value) {
  return {value, 0};
}

Number minus(const Number& a, const Number& b) {
  return a + Number{-b.value, b.error};
}

std::optional<Sign> sign_of(const Number& x) {
  if (x.value > x.error) return Sign::positive;
  if (-x.value > x.error) return Sign::negative;
  if (x.value == 0 && x.error == 0) return Sign::zero;
  return std::nullopt;
}

/// x·2^power; what lies below 2⁻¹⁰⁷⁴ is lost.
Number scaled(double x, long power) {
  const double value = std::ldexp(x, static_cast<int>(power));
  return {value, std::ldexp(value, static_cast<int>(-power)) == x ? 0 : most_underflow};
}

using Image = std::array<Number, 3>;

Number determinant(const Image& a, const Image& b, const Image& c) {
  return a[0] * minus(b[1] * c[2], b[2] * c[1]) + a[1] * minus(b[2] * c[0], b[0] * c[2]) +
         a[2] * minus(b[0] * c[1], b[1] * c[0]);
}

ExactVector3 to_vector(const HomogeneousImagePoint& p) {
  return {p.U, p.V, p.W};
}

}  // namespace

/// A segment that contains all that may hide a point, by its middle and its half, with how far
/// binary64 may be off in the tests of may_meet().
struct PointSight::Line {
  Vector middle, half;
  double margin, cross_margin;

  /// False only if the line certainly misses the exact triangles in the box: one of six directions
  /// separates them.
  /// Source   [Eri05] 5.3.3
  [[nodiscard]] bool may_meet(const Box& box) const {
    Vector m, h;
    for (std::size_t k = 0; k < 3; ++k) {
      m[k] = middle[k] - (box.lower[k] + box.upper[k]) / 2;
      h[k] = (box.upper[k] - box.lower[k]) / 2;
      if (std::abs(m[k]) > h[k] + std::abs(half[k]) + margin) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (std::abs(m[i] * half[j] - m[j] * half[i]) >
          h[i] * std::abs(half[j]) + h[j] * std::abs(half[i]) + cross_margin)
        return false;
    }
    return true;
  }
};

PointSight::PointSight(const TriangleSource& source, const PlacedTriangles& triangles,
                       const BoxTree& tree, const Camera& camera, Cull cull)
    : source_(source), triangles_(triangles), tree_(tree), camera_(camera), cull_(cull) {
  const long power = -triangles.power();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) pose_[i][k] = exactly(camera.world_to_camera[i][k]);
    pose_[i][3] = scaled(camera.world_to_camera[i][3], power);
  }
  near_ = scaled(camera.near, power);
  one_ = scaled(1, power);
  lens_ = is_mirrored(camera.projection) ? Sign::negative : Sign::positive;
  const auto inverse = camera_to_world(camera.world_to_camera);
  for (std::size_t k = 0; k < 3; ++k) {
    eye_[k] = is_perspective(camera.projection) ? std::ldexp(inverse[k][3], static_cast<int>(power))
                                                : -inverse[k][2];
  }
}

PointSight::View PointSight::view_of(const Vector& near, double error) const {
  const auto row = [&](std::size_t i) {
    Number sum = pose_[i][3];
    for (std::size_t k = 0; k < 3; ++k) sum = sum + pose_[i][k] * Number{near[k], error};
    return sum;
  };
  return {row(0), row(1), row(2)};
}

PointSight::Image PointSight::image_of(const View& view) const {
  const bool perspective = is_perspective(camera_.projection);
  return {view.x, view.y, perspective ? view.z : one_};
}

bool PointSight::is_kept(Sign turn) const {
  const Sign facing = turn * lens_;
  return cull_ == Cull::none ||
         (cull_ == Cull::back ? facing == Sign::negative : facing == Sign::positive);
}

/// Whether a triangle is neither seen edge on nor culled.
bool PointSight::shows_a_side(std::uint32_t triangle) const {
  std::array<Image, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = image_of(view_of(triangles_[triangle][i], bounds::corner_error));
  const auto turn = sign_of(determinant(corners[0], corners[1], corners[2]));
  if (turn) return *turn != Sign::zero && is_kept(*turn);
  TierCounts counts;
  const auto projected =
      triangle::project(source_.world_corners(triangle), triangle, camera_, counts);
  return projected.orientation != Sign::zero && triangle::is_kept(projected, cull_);
}

bool PointSight::is_in_range(const PlacedPoint& p, const View& view) const {
  const auto in_front = sign_of(view.z), beyond_near = sign_of(minus(view.z, near_));
  if (in_front == Sign::negative || beyond_near == Sign::negative) return false;
  if (in_front == Sign::positive && beyond_near == Sign::positive && std::isinf(camera_.far))
    return true;
  const Dyadic depth = to_camera(camera_.world_to_camera, p.exact).z;
  return depth.sign() == Sign::positive && depth >= Dyadic(camera_.near) &&
         (std::isinf(camera_.far) || depth <= Dyadic(camera_.far));
}

bool PointSight::is_in_image(const PlacedPoint& p, const View& view) const {
  const auto& [x, y, W] = image_of(view);
  const Number half_less_centre = exactly(0.5) + exactly(-camera_.projection.pixel_centre);
  const auto centred = [&](double c) { return exactly(c) + half_less_centre; };
  const Number u = exactly(camera_.projection.fx) * x + exactly(camera_.projection.skew) * y +
                   centred(camera_.projection.cx) * W;
  const Number v = exactly(camera_.projection.fy) * y + centred(camera_.projection.cy) * W;
  bool certain = true;
  for (const Number& inside :
       {u, minus(exactly(camera_.width) * W, u), v, minus(exactly(camera_.height) * W, v)}) {
    const auto sign = sign_of(inside);
    if (sign == Sign::negative) return false;
    certain = certain && sign;
  }
  if (certain) return true;
  const auto [U, V, exact_W] =
      to_image(camera_.projection, to_camera(camera_.world_to_camera, p.exact));
  return U.sign() != Sign::negative && V.sign() != Sign::negative &&
         U <= exact_W * Dyadic(camera_.width) && V <= exact_W * Dyadic(camera_.height);
}

// The point errs by at most bounds::point_error in each coordinate and the other end, at most M ≥ 1
// in each, by 2⁻⁵⁰·M: to a camera at infinity the line is long enough to leave the cube in which
// the scene lies. The margins are what the tests lose by that and by rounding (validation/proofs,
// evaluation_line and evaluation_cross). Where something is not finite, every test says that the
// line may meet the box.
PointSight::Line PointSight::line_to(const PlacedPoint& p) const {
  Vector end = eye_;
  if (is_orthographic(camera_.projection)) {
    const double size = std::max({std::abs(eye_[0]), std::abs(eye_[1]), std::abs(eye_[2])});
    for (std::size_t k = 0; k < 3; ++k) end[k] = p.near[k] + eye_[k] / size * 8;
  }
  Line line{};
  double M = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    line.middle[k] = (p.near[k] + end[k]) / 2;
    line.half[k] = (end[k] - p.near[k]) / 2;
    // Written so that NaN stays.
    M = std::abs(end[k]) <= M ? M : std::abs(end[k]);
  }
  line.margin = bounds::line_margin * M;
  line.cross_margin = bounds::cross_margin * M * M;
  return line;
}

/// With λ = w/Δ the point's image is Σ λᵢ·qᵢ of the corners' images q, and the plane of the
/// triangle has the depth Σ wᵢ·Dᵢ / Σ wᵢ there. Nothing where a sign is not settled or zero.
std::optional<bool> PointSight::hides_certainly(std::uint32_t number, const View& view) const {
  std::array<View, 3> corners;
  std::array<Image, 3> q;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = view_of(triangles_[number][i], bounds::corner_error);
    q[i] = image_of(corners[i]);
  }
  const Image p = image_of(view);
  std::array<Number, 3> w;
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
  const auto depth_less = [&](const Number& depth) -> std::optional<Sign> {
    Number sum = exactly(0);
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

bool PointSight::hides_exactly(std::uint32_t number, const PlacedPoint& p) const {
  TierCounts counts;
  const triangle::ProjectedTriangle t =
      triangle::project(source_.world_corners(number), number, camera_, counts);
  if (t.orientation == Sign::zero || !triangle::is_kept(t, cull_)) return false;
  const CameraPoint at = to_camera(camera_.world_to_camera, p.exact);
  const ExactVector3 q = to_vector(to_image(camera_.projection, at));
  for (const LinearForm& edge : t.edges)
    if (dot(edge.coefficients(), q).sign() == Sign::negative) return false;
  const Ratio depth(dot(t.depth_numerator.coefficients(), q), dot(t.weight.coefficients(), q));
  return depth.sign() == Sign::positive && !(depth < Ratio(Dyadic(camera_.near))) &&
         depth < Ratio(at.z);
}

bool PointSight::hides(std::uint32_t number, const PlacedPoint& p, const View& view) const {
  const auto certain = hides_certainly(number, view);
  return certain ? *certain : hides_exactly(number, p);
}

bool PointSight::is_hidden(std::uint32_t triangle, const PlacedPoint& p, const View& view) const {
  const Line line = line_to(p);
  const std::vector<BoxTree::Node>& nodes = tree_.nodes();
  std::vector<std::uint32_t> waiting{0};
  while (!waiting.empty()) {
    const std::uint32_t number = waiting.back();
    waiting.pop_back();
    const BoxTree::Node& node = nodes[number];
    if (!line.may_meet(node.box)) continue;
    if (node.count == 0) {
      waiting.push_back(node.first);
      waiting.push_back(number + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t other = tree_.order()[i];
      if (other != triangle && line.may_meet(box_of(triangles_[other])) && hides(other, p, view))
        return true;
    }
  }
  return false;
}

bool PointSight::sees(std::uint32_t triangle, const PlacedPoint& p) const {
  const View view = view_of(p.near, bounds::point_error);
  return is_in_range(p, view) && is_in_image(p, view) && shows_a_side(triangle) &&
         !is_hidden(triangle, p, view);
}

}  // namespace fathom::evaluation
