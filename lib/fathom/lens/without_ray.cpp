#include "fathom/lens/without_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fathom/camera/projection.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/lens/stage.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

using Reason = WithoutRay::Reason;

struct Place {
  double x, y;
};
using Polygon = std::vector<Place>;

/// Where a lens ends: on a circle of this radius, before the stage if the model has one.
struct Rim {
  Reason reason;
  double radius;
};

/// Of a stage on a circle.
struct OnCircle {
  /// The least eigenvalue of the symmetric part of the Jacobian; negative beyond a pole.
  double growth = HUGE_VAL;
  /// The least |S|.
  double size = HUGE_VAL;
};

/// At 64 points: between two of them little changes, as the degree in the angle is low.
OnCircle on_circle(const StageNumbers<double>& stage, double radius) {
  if (stage.is_double()) {
    const OnCircle first = on_circle(first_stage(stage), radius);
    const OnCircle second = on_circle(second_stage(stage), first.size);
    return {std::min(first.growth, second.growth), second.size};
  }
  OnCircle least;
  if (!(horner(stage.denominator, radius * radius) > 0)) return {-1, 0};
  const int points = is_radial(stage) ? 1 : 64;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    const StageJacobian<double> J = stage_jacobian(stage, x, y);
    const double growth = (J.xx + J.yy - std::hypot(J.xx - J.yy, J.xy + J.yx)) / 2;
    const StagePoint<double> p = stage_value(stage, x, y);
    least.growth = std::min(least.growth, growth);
    least.size = std::min(least.size, std::hypot(p.x, p.y));
  }
  return least;
}

/// The radius between two, the second of which is beyond the fold, at which the fold is.
double fold_between(const StageNumbers<double>& stage, double inner, double outer) {
  for (int i = 0; i < 40; ++i) {
    const double middle = inner + (outer - inner) / 2;
    (on_circle(stage, middle).growth > 0 ? inner : outer) = middle;
  }
  return inner;
}

/// Goes outwards, in steps of 2 %, to the first circle that is irregular, or whose image is farther
/// away than any sample. Nullopt if there is none.
std::optional<Rim> rim_of(const StageNumbers<double>& stage, double farthest, double max_radius) {
  constexpr int most_steps = 2000;  // 10¹⁵ times as far as the first one
  double inner = 0, radius = farthest / 64;
  for (int step = 0; step < most_steps && std::isfinite(radius); ++step, radius *= 1.02) {
    const double outer = std::min(radius, max_radius);
    const OnCircle least = on_circle(stage, outer);
    if (!(least.growth > 0)) return Rim{Reason::fold, fold_between(stage, inner, outer)};
    if (least.size >= farthest) return std::nullopt;
    if (radius >= max_radius) return Rim{Reason::max_radius, max_radius};
    inner = outer;
  }
  return std::nullopt;
}

/// The same for a lens, which may end nearer than the stage: a fisheye ends at 180° from its axis.
std::optional<Rim> rim_of_stage(const StageNumbers<double>& stage, double farthest,
                                const Lens& lens) {
  if (is_plane(lens.model) || lens.max_radius < std::numbers::pi)
    return rim_of(stage, farthest, lens.max_radius);
  std::optional<Rim> rim = rim_of(stage, farthest, std::numbers::pi);
  if (rim && rim->reason == Reason::max_radius) rim->reason = Reason::end_of_model;
  return rim;
}

// At the angle θ from the axis tan θ = r/(1 + k·r²): r is the lesser root of a quadratic equation.
// Angles that a model does not reach have none.
std::optional<Rim> rim_of_division(const Lens& lens) {
  const double k = division_term(lens);
  const double max_radius = lens.max_radius;
  const double end = k > 0 ? 1 / std::sqrt(k) : HUGE_VAL;
  const double cosine = std::cos(max_radius), sine = std::sin(max_radius);
  const double root = cosine * cosine - 4 * k * sine * sine;
  if (max_radius < std::numbers::pi && root >= 0) {
    const double radius = 2 * sine / (cosine + std::sqrt(root));
    if (radius > 0 && radius < end) return Rim{Reason::max_radius, radius};
  }
  return std::isfinite(end) ? std::optional(Rim{Reason::end_of_model, end}) : std::nullopt;
}

/// The radius is that of m.
std::optional<Rim> rim_of_stage_before_root(const StageNumbers<double>& stage,
                                            const RootProfile& profile, double farthest,
                                            const Lens& lens) {
  constexpr double far = 0x1p40;
  const std::optional<double> radius = profile.radius_at(lens.max_radius, far);
  std::optional<Rim> rim = rim_of(stage, farthest, radius.value_or(profile.end()));
  if (rim && rim->reason == Reason::max_radius && !radius) rim->reason = Reason::end_of_model;
  return rim;
}

// At the angle θ from the axis tan θ = tan(ωr)/(2·tan(ω/2)); ωr < π/2.
std::optional<Rim> rim_of_field_of_view(const Lens& lens) {
  const double omega = std::abs(lens.distortion[0]);
  const double right_angle = std::numbers::pi / 2;
  if (lens.max_radius < right_angle) {
    const double tangent = std::tan(lens.max_radius);
    const double radius =
        omega == 0 ? tangent : std::atan(2 * std::tan(omega / 2) * tangent) / omega;
    return Rim{Reason::max_radius, radius};
  }
  return omega == 0 ? std::nullopt : std::optional(Rim{Reason::end_of_model, right_angle / omega});
}

std::optional<Rim> rim_of_angle(const Lens& lens) {
  const AnglePolynomial angle(lens);
  const double radius = angle.radius_at(lens.max_radius);
  if (radius < angle.end()) return Rim{Reason::max_radius, radius};
  return Rim{Reason::end_of_model, radius};
}

std::optional<Rim> rim_of_root(const RootProfile& profile, double farthest, const Lens& lens) {
  if (const auto radius = profile.radius_at(lens.max_radius, farthest))
    return Rim{Reason::max_radius, *radius};
  if (!std::isfinite(profile.end())) return std::nullopt;
  return Rim{Reason::end_of_model, profile.end()};
}

/// From the plane before the stage to the image.
class Forward {
 public:
  /// `stage`: none of the models without one.
  Forward(const Projection& projection, const StageNumbers<double>* stage)
      : to_image_(projection), stage_(stage), tilt_(Tilt::of(*projection.lens)) {
    if (!tilt_) return;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) matrix_[i][k] = enclose(tilt_->matrix()[i][k]).lower;
  }

  /// Nullopt where the tilted sensor does not show the point, or its place is beyond binary64.
  [[nodiscard]] std::optional<Place> of(Place m) const {
    if (stage_ != nullptr) {
      const StagePoint<double> p = stage_value(*stage_, m.x, m.y);
      m = {p.x, p.y};
    }
    std::array<double, 3> tilted{};
    for (std::size_t i = 0; i < 3; ++i)
      tilted[i] = matrix_[i][0] * m.x + matrix_[i][1] * m.y + matrix_[i][2];
    const auto [x, y] = to_image_.image_of(tilted);
    if (!(tilted[2] > 0) || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return Place{x, y};
  }

  /// The distance from the axis of a place of the image behind the stage; +∞ if the tilted sensor
  /// has no such place.
  [[nodiscard]] double distance_from_axis(double u, double v) const {
    const auto [x, y] = to_image_.plane_point_at(u, v);
    if (!std::isfinite(x) || !std::isfinite(y)) return HUGE_VAL;
    if (!tilt_) return std::hypot(x, y);
    const auto p = tilt_->undone({x, y, 1.0});
    if (!p) return HUGE_VAL;
    const auto number = [](const Dyadic& d) { return enclose(d).lower; };
    return std::hypot(number(p->a), number(p->b)) / number(p->c);
  }

 private:
  RoundedProjection to_image_;
  const StageNumbers<double>* stage_;
  std::optional<Tilt> tilt_;
  std::array<std::array<double, 3>, 3> matrix_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// The image of the circle of this radius; empty if a part of it is not known. Between its corners
/// a circle is less than 10⁻⁵ of its radius away.
Polygon image_of_circle(const Forward& forward, double radius) {
  constexpr int corners = 1024;
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const auto place = forward.of({radius * std::cos(angle), radius * std::sin(angle)});
    if (!place) return {};
    polygon.push_back(*place);
  }
  return polygon;
}

/// The part of a polygon where `depth` ≥ 0, a linear function.
template <class Depth>
Polygon cut(const Polygon& polygon, const Depth& depth) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = depth(a), at_b = depth(b);
    if (at_a >= 0) part.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const double t = at_a / (at_a - at_b);
    part.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  }
  return part;
}

double area_within(Polygon polygon, double width, double height) {
  polygon = cut(polygon, [](const Place& p) { return p.x; });
  polygon = cut(polygon, [](const Place& p) { return p.y; });
  polygon = cut(polygon, [&](const Place& p) { return width - p.x; });
  polygon = cut(polygon, [&](const Place& p) { return height - p.y; });
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

std::optional<WithoutRay> of_table(const DirectionTable& table) {
  const std::uint64_t missing = table.pixels_without_ray();
  if (missing == 0) return std::nullopt;
  const double all = static_cast<double>(table.width()) * table.height();
  return WithoutRay{Reason::table, static_cast<double>(missing) / all};
}

/// Of a panorama: the columns of one row that have a ray within max_radius, as a number of pixels.
class PanoramaRow {
 public:
  PanoramaRow(const Projection& projection, std::uint32_t width)
      : turn_(projection.fx), width_(width), centre_(principal_point(projection).x) {}

  /// The columns whose angle to the middle is at most `half` ≤ π.
  [[nodiscard]] double columns_within(double half) const {
    const auto up_to = [&](double u) {
      const double turns = (u - centre_) / turn_ + 0.5, whole = std::floor(turns);
      const double share = half / std::numbers::pi, rest = turns - whole;
      return turn_ * (whole * share + std::clamp(rest - (1 - share) / 2, 0.0, share));
    };
    return up_to(width_) - up_to(0);
  }

 private:
  double turn_, width_, centre_;
};

/// The cosine of half the angle of a row that max_radius leaves: cos(max_radius) is cos φ·cos λ.
double cosine_of_half(const Lens& lens, double y) {
  if (lens.max_radius > std::numbers::pi) return -1;
  const double level =
      lens.model == LensModel::cylindrical ? 1 / std::hypot(1, y) : std::cos(std::numbers::pi * y);
  const double cosine = std::cos(lens.max_radius) / std::max(level, 0x1p-1000);
  return std::clamp(cosine, -1.0, 1.0);
}

/// In 4096 rows of equal height.
std::optional<WithoutRay> of_panorama(const Projection& projection, std::uint32_t width,
                                      std::uint32_t height) {
  constexpr int rows = 4096;
  const RoundedProjection to_image(projection);
  const PanoramaRow row(projection, width);
  const Lens& lens = *projection.lens;
  double seen = 0;
  for (int i = 0; i < rows; ++i) {
    const double y = to_image.plane_point_at(0, (i + 0.5) / rows * height)[1];
    if (lens.model == LensModel::equirectangular && std::abs(y) > 0.5) continue;
    seen += row.columns_within(std::acos(cosine_of_half(lens, y))) / width / rows;
  }
  const double missing = 1 - seen;
  if (!(missing * width * height >= 0.5)) return std::nullopt;
  const bool ends = std::isfinite(lens.max_radius);
  return WithoutRay{ends ? Reason::max_radius : Reason::end_of_model, missing};
}

}  // namespace

std::optional<WithoutRay> find_samples_without_ray(const Projection& projection,
                                                   std::uint32_t width, std::uint32_t height) {
  const StandardArithmetic standard;
  if (!projection.lens || is_pinhole(*projection.lens)) return std::nullopt;
  if (projection.lens->directions) return of_table(*projection.lens->directions);
  if (is_panorama(projection.lens->model)) return of_panorama(projection, width, height);
  const Lens& lens = *projection.lens;
  const bool is_before_root = has_stage_before_root(lens);
  const bool is_by_stage = has_stage(lens.model) || is_before_root;
  const StageNumbers<double> stage = stage_of(is_by_stage ? lens : Lens());
  const Forward forward(projection, is_by_stage ? &stage : nullptr);
  double farthest = 0;
  for (const double u : {0.0, static_cast<double>(width)})
    for (const double v : {0.0, static_cast<double>(height)})
      farthest = std::max(farthest, forward.distance_from_axis(u, v));
  const auto rim = [&] {
    const auto roots = root_formula(lens);
    if (is_before_root) return rim_of_stage_before_root(stage, RootProfile(*roots), farthest, lens);
    if (is_by_stage) return rim_of_stage(stage, farthest, lens);
    if (lens.model == LensModel::fov) return rim_of_field_of_view(lens);
    if (lens.model == LensModel::ftheta) return rim_of_angle(lens);
    return roots ? rim_of_root(RootProfile(*roots), farthest, lens) : rim_of_division(lens);
  }();
  if (!rim) return std::nullopt;
  const Polygon seen = image_of_circle(forward, rim->radius);
  if (seen.empty()) return std::nullopt;
  const double all = static_cast<double>(width) * height;
  const double missing = all - area_within(seen, width, height);
  if (!(missing >= 0.5)) return std::nullopt;
  return WithoutRay{rim->reason, missing / all};
}

namespace {

/// Whether the sample lies behind the plane of a tilted sensor.
bool is_behind_sensor(const Preimages& preimages, std::uint32_t column, std::uint32_t row) {
  const ExactVector3 z = preimages.plane_map()[2];
  const Dyadic value = z[0] * Dyadic(column + 0.5) + z[1] * Dyadic(row + 0.5) + z[2];
  return value.sign() != Sign::positive;
}

}  // namespace

std::string why_no_ray(const Projection& projection, std::uint32_t column, std::uint32_t row) {
  const StandardArithmetic standard;
  Lens endless = *projection.lens;
  endless.max_radius = std::numeric_limits<double>::infinity();
  const Preimages preimages(projection, endless);
  if (preimages.of_pixel(column, row)) return "it is beyond max_radius";
  if (endless.directions) return "the table has no direction for this pixel";
  if (is_panorama(endless.model)) return "it is beyond a pole, 90 degrees above or below";
  if (preimages.stage() == nullptr) return "the model ends nearer to its axis";
  if (is_behind_sensor(preimages, column, row)) return "it is behind the tilted sensor";
  const bool is_last_angle = !is_plane(endless.model) && preimages.disc() == end_of_angles;
  return is_last_angle ? "it is 180 degrees or more from the axis"
                       : "the lens folds nearer to its axis";
}

}  // namespace fathom::lens
