#include "fathom/lens/without_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fathom/camera/rounded_projection.h"
#include "fathom/lens/preimages.h"
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

std::optional<Rim> rim_of(const PolynomialStage& stage) {
  if (!stage.limit) return std::nullopt;
  const bool is_fold = std::isfinite(stage.disc) && *stage.limit == Dyadic(stage.disc);
  return Rim{is_fold ? Reason::fold : Reason::max_radius, std::sqrt(enclose(*stage.limit).upper)};
}

// At the angle θ from the axis tan θ = r/(1 + k·r²): r is the lesser root of a quadratic equation.
// Angles that a model does not reach have none.
std::optional<Rim> rim_of_division(double k, double max_radius) {
  const double end = k > 0 ? 1 / std::sqrt(k) : HUGE_VAL;
  const double cosine = std::cos(max_radius), sine = std::sin(max_radius);
  const double root = cosine * cosine - 4 * k * sine * sine;
  if (max_radius < std::numbers::pi && root >= 0) {
    const double radius = 2 * sine / (cosine + std::sqrt(root));
    if (radius > 0 && radius < end) return Rim{Reason::max_radius, radius};
  }
  return std::isfinite(end) ? std::optional(Rim{Reason::end_of_model, end}) : std::nullopt;
}

std::optional<Rim> rim_of(const Preimages& preimages, const Lens& lens) {
  if (const PolynomialStage* const stage = preimages.stage()) return rim_of(*stage);
  const bool is_division = lens.model != LensModel::fisheye_stereographic;
  return rim_of_division(is_division ? lens.distortion[0] : -0.25, lens.max_radius);
}

/// From the plane before the stage to the image.
class Forward {
 public:
  Forward(const Projection& projection, const PolynomialStage* stage)
      : to_image_(projection), stage_(stage) {
    if (const std::optional<Tilt> tilt = Tilt::of(*projection.lens)) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) tilt_[i][k] = enclose(tilt->matrix()[i][k]).lower;
    }
  }

  /// Nullopt where the tilted sensor does not show the point, or its place is beyond binary64.
  [[nodiscard]] std::optional<Place> of(Place m) const {
    if (stage_ != nullptr) {
      const StagePoint<double> p = stage_value(stage_->numbers, m.x, m.y);
      m = {p.x, p.y};
    }
    std::array<double, 3> tilted{};
    for (std::size_t i = 0; i < 3; ++i)
      tilted[i] = tilt_[i][0] * m.x + tilt_[i][1] * m.y + tilt_[i][2];
    const auto [x, y] = to_image_.image_of(tilted);
    if (!(tilted[2] > 0) || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return Place{x, y};
  }

 private:
  RoundedProjection to_image_;
  const PolynomialStage* stage_;
  std::array<std::array<double, 3>, 3> tilt_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
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

}  // namespace

std::optional<WithoutRay> find_samples_without_ray(const Projection& projection,
                                                   std::uint32_t width, std::uint32_t height) {
  const StandardArithmetic standard;
  if (!projection.lens || is_pinhole(*projection.lens)) return std::nullopt;
  if (projection.lens->directions) return of_table(*projection.lens->directions);
  const Preimages preimages(projection, *projection.lens);
  const std::optional<Rim> rim = rim_of(preimages, *projection.lens);
  if (!rim) return std::nullopt;
  const Polygon seen = image_of_circle(Forward(projection, preimages.stage()), rim->radius);
  if (seen.empty()) return std::nullopt;
  const double all = static_cast<double>(width) * height;
  const double missing = all - area_within(seen, width, height);
  if (!(missing >= 0.5)) return std::nullopt;
  return WithoutRay{rim->reason, missing / all};
}

}  // namespace fathom::lens
