#include "fathom/attribution/faults/residuals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/sample_grid.h"
#include "fathom/attribution/robust_statistics.h"
#include "fathom/geometry/eigen_arrays.h"

// The affine value a of a surface is 1/D (perspective) or D (orthographic): over a triangle it is
// m·r, r = (x, y, 1) the point of the plane at depth 1 (orthographic: of any plane) that a pixel
// shows. A turn ω and a move τ of the camera take m to m − m × ω − m(m·τ) in first order.
namespace fathom::attribution {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using P = Parameter;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Maximum number of examined pixels, and minimum number for an estimate.
constexpr std::size_t most_pixels = 30000;
constexpr Eigen::Index least_pixels = 64;

int index_of(P p) {
  return static_cast<int>(p);
}

/// A triangle's plane in the frame of a camera: n·X = c.
struct Plane {
  Vector3d n;
  double c = 0;
  Vector3d first, to_second, to_third;  ///< the first corner, and the vectors to the others
};

Vector3d corner_parts(const Plane& plane, const Vector3d& point) {
  const Vector3d p = point - plane.first, n = plane.n / plane.n.squaredNorm();
  const double second = p.cross(plane.to_third).dot(n), third = plane.to_second.cross(p).dot(n);
  return {1 - second - third, second, third};
}

Plane plane_of(const WorldMesh& mesh, std::uint32_t triangle, const Camera& camera) {
  const auto view = geometry::as_matrix(camera.world_to_camera);
  const auto corner = [&](std::uint32_t k) -> Vector3d {
    const Vector3d p = geometry::as_vector(mesh.points[mesh.triangles[triangle][k]]);
    return view.leftCols<3>() * p + view.col(3);
  };
  const Vector3d a = corner(0), b = corner(1), d = corner(2);
  const Vector3d n = (b - a).cross(d - a);
  return {n, n.dot(a), a, b - a, d - a};
}

/// The affine value over a triangle, its derivatives by x and y, by turn and by move.
struct AffineValue {
  double a = 0, by_x = 0, by_y = 0;
  Vector3d by_turn, by_move;
};

AffineValue perspective_value(const Plane& plane, const Vector3d& r) {
  const Vector3d m = plane.n / plane.c;
  const double a = m.dot(r);
  return {a, m.x(), m.y(), m.cross(r), -a * m};
}

/// D = (c − n_x·x − n_y·y)/n_z; n becomes n + ω × n, c becomes c + n·τ.
AffineValue orthographic_value(const Plane& plane, const Vector3d& r) {
  const Vector3d& n = plane.n;
  const double depth = (plane.c - n.x() * r.x() - n.y() * r.y()) / n.z();
  AffineValue v{depth, -n.x() / n.z(), -n.y() / n.z(), {}, n / n.z()};
  const Vector3d hit(r.x(), r.y(), depth);
  v.by_turn = -n.cross(hit) / n.z();  // −(ω × n)·hit / n_z = −ω·(n × hit)/n_z
  return v;
}

/// Where a pixel's sample is on the plane at depth 1, ideal and as the lens shows it.
struct SamplePoint {
  double x = 0, y = 0, shown_y = 0, shown_x = 0;
};

SamplePoint sample_point(const Camera& c, const SamplePosition& sample, std::size_t pixel) {
  const std::size_t column = pixel % c.width, row = pixel / c.width;
  const auto [shown_x, shown_y] = RoundedProjection(c.projection)
                                      .plane_point_at(static_cast<double>(column) + sample.x,
                                                      static_cast<double>(row) + sample.y);
  const auto [x, y] = undistorted(shown_x, shown_y, sample.k1, sample.k2);
  return {.x = x, .y = y, .shown_y = shown_y, .shown_x = shown_x};
}

/// Derivatives of the affine value by the point where the lens shows it: the derivatives by the
/// ideal point p times the inverse of ∂(f·p)/∂p = f·1 + 2f′·p·pᵀ, f = 1 + k1·|p|² + k2·|p|⁴.
Vector2d by_shown(const AffineValue& v, const SamplePoint& s, const SamplePosition& lens) {
  const Vector2d by_ideal(v.by_x, v.by_y), p(s.x, s.y);
  const double square = p.squaredNorm();
  const double factor = 1 + square * (lens.k1 + square * lens.k2);
  const double change = 2 * (lens.k1 + 2 * square * lens.k2);
  return (by_ideal - p * (change * p.dot(by_ideal) / (factor + change * square))) / factor;
}

/// Derivatives of the affine value by the parameters that move the view.
void set_view_slopes(const Camera& c, const AffineValue& v, const SamplePoint& s,
                     const SamplePosition& lens,
                     Eigen::Ref<Eigen::Matrix<double, 1, parameter_count>> slopes) {
  slopes.segment<3>(index_of(P::turn_x)) = v.by_turn.transpose();
  slopes.segment<3>(index_of(P::move_x)) = v.by_move.transpose();
  const double skew = c.projection.skew / c.projection.fx;
  const Vector2d by = by_shown(v, s, lens);
  slopes[index_of(P::focal_x)] = -by.x() * s.shown_x;
  slopes[index_of(P::focal_y)] = -by.y() * s.shown_y + by.x() * skew * s.shown_y;
  slopes[index_of(P::centre_x)] = -by.x() / c.projection.fx;
  slopes[index_of(P::centre_y)] = (-by.y() + by.x() * skew) / c.projection.fy;
  slopes[index_of(P::skew)] = -by.x() * s.shown_y / c.projection.fx;
  if (!is_perspective(c.projection)) return;
  const double square = s.x * s.x + s.y * s.y;
  const double outwards = -(by.x() * s.x + by.y() * s.y) * square;
  slopes[index_of(P::k1)] = outwards;
  slopes[index_of(P::k2)] = outwards * square;
}

void set_depth_slopes(const DepthDeviation& depths, double a,
                      Eigen::Ref<Eigen::Matrix<double, 1, parameter_count>> slopes) {
  const DepthDeviation::Slopes s = depths.slopes(a);
  slopes *= s.a;
  slopes[index_of(P::scale)] = s.scale;
  slopes[index_of(P::offset)] = s.offset;
  slopes[index_of(P::near)] = s.near;
  slopes[index_of(P::far)] = s.far;
  slopes[index_of(P::bias)] = s.bias;
}

/// Half a step of the recorded precision, relative to the depth.
double half_step(const RecordedDepth& recorded, double depth) {
  const double value = recorded.exact(depth), step = recorded.step_at(value);
  const double width = recorded.to_depth(value + step / 2) - recorded.to_depth(value - step / 2);
  return std::abs(width / depth) / 2;
}

/// The middle of the depths that are rounded down to a recorded depth.
double middle_of_step(const RecordedDepth& recorded, double depth) {
  if (recorded.rounding != RecordedDepth::Rounding::down) return depth;
  return recorded.to_depth(recorded.exact(depth) + recorded.step / 2);
}

std::vector<double> absolutes(const Eigen::VectorXd& r) {
  std::vector<double> values(static_cast<std::size_t>(r.size()));
  Eigen::Map<Eigen::VectorXd>(values.data(), r.size()) = r.cwiseAbs();
  return values;
}

}  // namespace

double Residuals::median() const {
  std::vector<double> values = absolutes(r);
  return values.empty() ? infinity : median_of(values);
}

double Residuals::cost() const {
  std::vector<double> values = absolutes(r);
  const std::size_t count = values.size() * 4 / 5;
  if (count == 0) return infinity;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count),
                   values.end());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i] * values[i];
  return sum / static_cast<double>(count);
}

ResidualSource::ResidualSource(const Truth& truth, const OtherMap& other,
                               const RendererModel& model, const Attribution& found)
    : other_(other), model_(model), found_(found), camera_(truth.camera) {
  std::vector<double> widths;
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    if (!(truth.depths[i] < infinity)) continue;
    ++surfaces;
    const double width = (double{found.greatest[i]} - found.least[i]) / 2 / truth.depths[i];
    if (found.clues.alone[i] != 0 && width < infinity) widths.push_back(width);
  }
  typical_width_ = widths.empty() ? infinity : median_of(widths);
  stride_ = surfaces / most_pixels + 1;
}

bool ResidualSource::has_enough(const Residuals& residuals) const {
  return residuals.r.size() >= least_pixels && typical_width_ < infinity;
}

/// Half width of the model's interval, relative to the depth; never much less than the typical half
/// width. The expectation is not rounded to the recorded precision, whose step is added.
double ResidualSource::relative_width(std::size_t pixel) const {
  const double least = found_.least[pixel], greatest = found_.greatest[pixel];
  const double width = (greatest - least) / (greatest + least);
  const bool is_known = found_.clues.alone[pixel] != 0 && width < infinity && width > 0;
  const double allowed = is_known ? std::max(width, typical_width_ / 8) : typical_width_;
  if (!model_.recorded) return allowed;
  return allowed + half_step(*model_.recorded, other_.depths[pixel]);
}

Residuals ResidualSource::of(const Truth& seen, const Deviation& deviation) const {
  const Camera& camera = seen.camera;
  const bool perspective = is_perspective(camera.projection);
  SamplePosition sample = model_.sample;
  sample.k1 += attribution::of(deviation, P::k1);
  sample.k2 += attribution::of(deviation, P::k2);
  const SampleGrid grid(camera, sample);
  const DepthDeviation depths(camera_, model_, deviation);
  std::unordered_map<std::uint32_t, Plane> planes;

  Residuals result;
  std::vector<double> r;
  std::vector<Eigen::Matrix<double, 1, parameter_count>> slopes;
  std::vector<Vector3d> parts;
  std::size_t count = 0;
  for (std::size_t i = 0; i < seen.depths.size(); ++i) {
    std::size_t shown = i;  // the pixel whose triangle the lens shows here
    if (sample.k1 != 0 || sample.k2 != 0) {
      const auto [u, v] = grid.at(static_cast<std::uint32_t>(i % camera.width),
                                  static_cast<std::uint32_t>(i / camera.width));
      if (!(u >= 0 && u < camera.width && v >= 0 && v < camera.height)) continue;
      shown = static_cast<std::size_t>(v) * camera.width + static_cast<std::size_t>(u);
    }
    const std::uint32_t triangle = seen.triangles[shown];
    if (triangle == no_surface || !(std::abs(other_.depths[i]) < infinity)) continue;
    if (count++ % stride_ != 0) continue;
    const auto [plane, is_new] = planes.try_emplace(triangle);
    if (is_new) plane->second = plane_of(seen.mesh, triangle, camera);
    const SamplePoint s = sample_point(camera, sample, i);
    const Vector3d ray(s.x, s.y, 1);
    const AffineValue v = perspective ? perspective_value(plane->second, ray)
                                      : orthographic_value(plane->second, ray);
    const double expected = depths.of(v.a);
    const double depth =
        model_.recorded ? middle_of_step(*model_.recorded, other_.depths[i]) : other_.depths[i];
    const double stored = perspective ? 1 / depth : depth;
    const double width = relative_width(i) * std::abs(expected);
    const double residual = (stored - expected) / width;
    Eigen::Matrix<double, 1, parameter_count> row =
        Eigen::Matrix<double, 1, parameter_count>::Zero();
    set_view_slopes(camera, v, s, sample, row);
    set_depth_slopes(depths, v.a, row);
    row /= width;
    if (!std::isfinite(residual) || !row.allFinite()) continue;
    r.push_back(residual);
    slopes.push_back(row);
    result.triangles.push_back(triangle);
    const Vector3d hit = perspective ? Vector3d(ray / v.a) : Vector3d(s.x, s.y, v.a);
    parts.push_back(corner_parts(plane->second, hit));
  }
  result.r = Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
  result.slopes.resize(result.r.size(), parameter_count);
  result.corner_parts.resize(result.r.size(), 3);
  for (Eigen::Index k = 0; k < result.r.size(); ++k) {
    result.slopes.row(k) = slopes[static_cast<std::size_t>(k)];
    result.corner_parts.row(k) = parts[static_cast<std::size_t>(k)].transpose();
  }
  return result;
}

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Standard deviation of a number that is uniform in [−1, 1].
constexpr double uniform_variance = 1.0 / 3;

/// The effect of one corner on the parameters.
struct CornerEffect {
  VectorXd shown;    ///< by the residuals about it
  VectorXd allowed;  ///< where it is off by all that the model allows
};

}  // namespace

StandardDeviations standard_deviations(const Truth& truth, const Residuals& residuals,
                                       const MatrixXd& columns, const VectorXd& weights) {
  const Normal normal = normal_of(columns, residuals.r, weights);
  if (!normal.is_regular) {
    const VectorXd unknown =
        VectorXd::Constant(columns.cols(), std::numeric_limits<double>::infinity());
    return {unknown, unknown};
  }
  // By how much a parameter changes with each residual.
  const MatrixXd gain = normal.inverse() * columns.transpose() * weights.asDiagonal();
  const VectorXd zero = VectorXd::Zero(columns.cols());
  std::unordered_map<std::uint32_t, CornerEffect> effects;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto& corners = truth.mesh.triangles[residuals.triangles[static_cast<std::size_t>(i)]];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [effect, is_new] = effects.try_emplace(truth.corner_numbers[corners[k]]);
      if (is_new) effect->second = {zero, zero};
      effect->second.shown += residuals.r[i] * gain.col(i);
      effect->second.allowed +=
          residuals.corner_parts(i, static_cast<Eigen::Index>(k)) * gain.col(i);
    }
  }
  VectorXd shown = zero, allowed = zero;
  for (const auto& [corner, effect] : effects) {
    shown += effect.shown.cwiseAbs2();
    allowed += uniform_variance * effect.allowed.cwiseAbs2();
  }
  return {shown.cwiseSqrt(), (shown + allowed).cwiseSqrt()};
}

Normal normal_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& r,
                 const Eigen::VectorXd& weights) {
  Normal n;
  const Eigen::MatrixXd weighted = weights.asDiagonal() * columns;
  Eigen::MatrixXd products = columns.transpose() * weighted;
  n.scale = products.diagonal().cwiseSqrt().cwiseInverse();
  if (!n.scale.allFinite()) return n;
  products = n.scale.asDiagonal() * products * n.scale.asDiagonal();
  n.products.compute(products);
  n.right = n.scale.cwiseProduct(weighted.transpose() * r);
  n.is_regular = n.products.info() == Eigen::Success && n.products.rcond() > 1e-11;
  return n;
}

}  // namespace fathom::attribution
