#include "fathom/fast/lenses/direction_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/fast/lenses/plane_places.h"
#include "fathom/lens/turn_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"

// A place is a quotient of two components, which err by `error` each: with A, W the exact ones,
// │a/w − A/W│ = │a·W − A·w│/(w·W) ≤ error·(1 + │a/w│)/W, W ≥ w − error, and a rounding. The
// components of a table are exact, so that its places are quotients rounded once.
namespace fathom::fast {
using namespace place_arithmetic;

namespace {

/// Covers products that underflow.
constexpr double underflow = std::numeric_limits<double>::min();
/// Coordinates of a tile that is in one view: up to 76° from its axis.
constexpr double most_in_one_view = 4;

/// sin √q/√q where `first` is 1 and cos √q where it is 0: Σ (−q)^k·first!/(2k + first)!, by the
/// scheme of Horner.
template <int first>
double alternating_series(double q) {
  constexpr int terms = 18;
  double sum = 1;
  for (int k = terms; k > 0; --k) sum = 1 - q / ((2 * k + first - 1) * (2 * k + first)) * sum;
  return sum;
}

/// (m·sin θ/θ, cos θ) with θ = |m|; the error is that of the arithmetic.
///
/// With q = θ²: cos θ = s_1 and s_k = 1 − r_k·s_{k+1}, r_k = q/((2k−1)·2k). From k = 2 on r_k < 1,
/// the terms of s_k alternate and fall, and 0 < s_k ≤ 1. The step to ŝ_k multiplies the error of
/// s_{k+1} by r_k, and adds r_k·2u for the quotient and the product and u for the difference: less
/// than 4u from k = 2 on. So the error of s_2 is below 4u·(1 + 10/12·(1 + 10/30·(1 + …))) < 9u, and
/// the error of cos θ is below 5·(9u + 2u) + u = 56u. In the same way, with r_k = q/(2k·(2k + 1)),
/// the error of sin θ/θ is below 10/6·(7u + 2u) + u = 16u. That s_19 is taken for 1 changes less
/// than 10¹⁸/36! < 2⁻⁷⁷. q errs by 2u of it, which moves cos θ by at most ½·20u and sin θ/θ by at
/// most 20u/6. A component of m, which is below 3.2, times sin θ/θ errs by 3.2·20u + u.
ApproximateDirection lifted(double x, double y) {
  const double q = x * x + y * y;
  const double sine_over_angle = alternating_series<1>(q);
  return {{x * sine_over_angle, y * sine_over_angle, alternating_series<0>(q)}, lift_rounding};
}

/// The same direction, scaled by a power of two so that its greatest component is about 1; smaller
/// components may underflow, by at most `underflow`.
ApproximateDirection scaled(const ApproximateDirection& direction) {
  const auto& [x, y, z] = direction.d;
  const double greatest = std::max({std::abs(x), std::abs(y), std::abs(z)});
  const int power = -std::ilogb(greatest);
  const auto times = [power](double a) {
    return std::ldexp(std::ldexp(a, power / 2), power - power / 2);
  };
  return {{times(x), times(y), times(z)}, times(direction.error) + underflow};
}

}  // namespace

// The sign of z − │d│·cos(max_radius). The length errs by √3·error at most, and by 4u of it in
// computing.
std::optional<bool> AngleLimit::keeps(const ApproximateDirection& direction) const {
  if (!cosine_) return true;
  const auto [d, error] = scaled(direction);
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const double cosine = cosine_->lower / 2 + cosine_->upper / 2;
  const double value = d[2] - length * cosine;
  const double doubt = (angle_of_error * error + length * (cosine_->upper - cosine_->lower) +
                        angle_rounding * (length + 1)) *
                       up;
  if (value > doubt) return true;
  if (value < -doubt) return false;
  return std::nullopt;
}

DirectionModel::DirectionModel(const lens::Preimages& the_preimages, const Projection& projection,
                               const TileGrid& grid)
    : preimages_(the_preimages),
      grid_(grid),
      table_(projection.lens->directions.get()),
      model_(projection.lens->model),
      k_(lens::division_term(*projection.lens)),
      plane_(table_ != nullptr || the_preimages.stage() != nullptr
                 ? CertifiedPlane()
                 : CertifiedPlane(the_preimages, projection, grid.width, grid.height)),
      limit_{the_preimages.cosine_of_end()} {
  if (the_preimages.stage() != nullptr) before_stage_.emplace(the_preimages, projection, grid);
  if (const auto exact = lens::root_formula(*projection.lens))
    roots_ = lens::converted(*exact, [](const Dyadic& x) { return to_certified(enclose(x)); });
  if (model_ != LensModel::fov) return;
  omega_.value = std::abs(projection.lens->distortion[0]);
  stretch_ = to_certified(lens::stretch_of_field(omega_.value));
}

template <class DirectionAt>
std::vector<DirectionModel::Sample> DirectionModel::collected(std::uint32_t tile,
                                                              const DirectionAt& at) const {
  const PixelBox area = grid_.area(tile);
  std::vector<Sample> samples;
  samples.reserve(TileShape::samples);
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
      if (column >= grid_.width || row >= grid_.height) continue;
      if (const std::optional<ApproximateDirection> direction = at(column, row))
        samples.push_back({column, row, *direction});
    }
  }
  return samples;
}

std::vector<DirectionModel::Sample> DirectionModel::of_tile(std::uint32_t tile) const {
  if (before_stage_) return tile_by_stage(tile);
  return collected(tile, [this](std::uint32_t column, std::uint32_t row) {
    if (table_ != nullptr) return in_table(column, row);
    if (is_panorama(model_)) return turned(column, row);
    if (model_ == LensModel::fov) return in_field_of_view(column, row);
    if (model_ == LensModel::ftheta) return by_angle(column, row);
    if (!roots_) return divided(column, row);
    return by_root(plane_.at(column + 0.5, row + 0.5), plane_.error(), column, row);
  });
}

// A step of m moves the d of a fisheye by at most its length, because sin θ/θ ≤ 1; both components
// of m err.
std::vector<DirectionModel::Sample> DirectionModel::tile_by_stage(std::uint32_t tile) const {
  std::vector<double> x(TileShape::samples), y(TileShape::samples);
  const double of_m = before_stage_->find(tile, {x, y}).error;
  const double of_angle = std::numbers::sqrt2 * up * of_m;
  const PixelBox area = grid_.area(tile);
  return collected(tile, [&](std::uint32_t column, std::uint32_t row) {
    const std::size_t i = TileShape::index(column - area.first_column, row - area.first_row);
    if (!(x[i] == x[i])) return std::optional<ApproximateDirection>();
    if (roots_) return by_root({x[i], y[i]}, of_m, column, row);
    if (!(x[i] * x[i] + y[i] * y[i] < end_of_series)) return exactly_at(column, row);
    const ApproximateDirection d = lifted(x[i], y[i]);
    return std::optional(ApproximateDirection{d.d, (d.error + of_angle) * up});
  });
}

std::optional<ApproximateDirection> DirectionModel::kept(const ApproximateDirection& direction,
                                                         std::uint32_t column,
                                                         std::uint32_t row) const {
  const std::optional<bool> keeps = limit_.keeps(direction);
  if (!keeps) return exactly_at(column, row);
  return *keeps ? std::optional(direction) : std::nullopt;
}

std::optional<ApproximateDirection> DirectionModel::in_table(std::uint32_t column,
                                                             std::uint32_t row) const {
  const auto d = table_->at(column, row);
  if (!d) return std::nullopt;
  return kept({*d, 0}, column, row);
}

// With x_d and y_d that err by e, x² + y² errs by 2e(│x│ + │y│) + 2e², and by 2u of it in
// computing; the product with k and the sum with 1 are rounded once each. There is a ray where
// k·r² < 1.
std::optional<ApproximateDirection> DirectionModel::divided(std::uint32_t column,
                                                            std::uint32_t row) const {
  const double e = plane_.error();
  if (!(e < 1)) return exactly_at(column, row);
  const auto [x, y] = plane_.at(column + 0.5, row + 0.5);
  const double squared = x * x + y * y;
  const double bend = k_ * squared;
  const double of_squared =
      2 * e * (std::abs(x) + std::abs(y)) + 2 * e * e + square_rounding * squared + underflow;
  const double of_z =
      (std::abs(k_) * of_squared + bend_rounding * (1 + std::abs(bend)) + underflow) * up;
  if (bend - of_z > 1) return std::nullopt;
  if (!(bend + of_z < 1)) return exactly_at(column, row);
  return kept({{x, y, 1 + bend}, std::max(e, of_z)}, column, row);
}

namespace {

using Bounded = std::array<Certified<double>, 3>;

/// The components; nothing where the sample has no ray. Bounds are infinite where that is open.
std::optional<Bounded> bounded_direction(const lens::AnyRootFormula<Certified<double>>& formula,
                                         const lens::HomogeneousPoint<Certified<double>>& y) {
  return std::visit(
      [&y](const auto& f) -> std::optional<Bounded> {
        const auto d = f.at(y);
        if (certain_sign(d.s) == Sign::negative) return std::nullopt;
        return d.components();
      },
      formula);
}

/// Of 2π·turns; each errs by at most turn_rounding.
///
/// The rest r after whole quarters, |r| ≤ ⅛, is exact. θ = 2πr errs by 2u of it, and θ² by 5u. In
/// the series (lifted()), with q = θ² < 0.62, r_1·s_2 errs by 0.31·3.2u, and the difference by u/2:
/// cos θ by less than 1.5u + ½·5u·0.62 < 3.1u. Likewise sin θ/θ errs by less than 0.9u + 5u·0.62/6
/// < 1.5u, and its product with θ < 0.79 by less than 0.79·(1.5u + 2u) + u/2 < 3.3u.
lens::SineAndCosine<double> of_turns(double turns) {
  const double quarters = std::nearbyint(4 * turns);
  const double angle = (turns - quarters / 4) * (2 * std::numbers::pi);
  const double sine = angle * alternating_series<1>(angle * angle);
  const double cosine = alternating_series<0>(angle * angle);
  return lens::after_quarters<double>(static_cast<long>(quarters), {sine, cosine});
}

}  // namespace

// There is a ray where s > 0. Each operation carries the bound of its operands.
std::optional<ApproximateDirection> DirectionModel::by_root(const std::array<double, 2>& point,
                                                            double error, std::uint32_t column,
                                                            std::uint32_t row) const {
  const std::optional<Bounded> bounded =
      bounded_direction(*roots_, {{point[0], error}, {point[1], error}, {1, 0}});
  if (!bounded) return std::nullopt;
  return kept(*bounded, column, row);
}

std::optional<ApproximateDirection> DirectionModel::kept(const Bounded& bounded,
                                                         std::uint32_t column,
                                                         std::uint32_t row) const {
  ApproximateDirection direction{{}, 0};
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [value, error] = bounded[k];
    if (!(error < std::numeric_limits<double>::infinity())) return exactly_at(column, row);
    direction.d[k] = value;
    direction.error = std::max(direction.error, error);
    size = std::max(size, std::abs(value));
  }
  if (!(direction.error < size)) return exactly_at(column, row);
  return kept(direction, column, row);
}

namespace {

struct BoundedSineAndCosine {
  Certified<double> sine_over_angle, cosine;
};

/// sin √q/√q and cos √q, q < end_of_series. The derivatives by q are at most ⅙ and ½. What
/// lens_sine proves of x·sin θ/θ for x = 2, whose product is exact, holds for sin θ/θ, too.
BoundedSineAndCosine of_square(const Certified<double>& q) {
  return {{alternating_series<1>(q.value), (lift_rounding + q.error / 6) * up},
          {alternating_series<0>(q.value), (lift_rounding + q.error / 2) * up}};
}

}  // namespace

// There is a ray where r ≤ R. At r = 0 the quotient has no bound.
std::optional<ApproximateDirection> DirectionModel::by_angle(std::uint32_t column,
                                                             std::uint32_t row) const {
  const lens::AnglePolynomial& polynomial = *preimages_.angle();
  const auto [x_value, y_value] = plane_.at(column + 0.5, row + 0.5);
  const Certified<double> x{x_value, plane_.error()}, y{y_value, plane_.error()};
  const Certified<double> r = sqrt(x * x + y * y);
  const Interval enclosed = enclose(r);
  if (enclosed.lower > polynomial.end()) return std::nullopt;
  if (!(enclosed.upper <= polynomial.end())) return exactly_at(column, row);
  Certified<double> angle{0, 0};
  for (std::size_t i = polynomial.coefficients().size(); i-- > 0;)
    angle = angle * r + to_certified(enclose(polynomial.coefficients()[i]));
  const Certified<double> q = angle * angle;
  if (!(q.value < end_of_series)) return exactly_at(column, row);
  const auto [sine_over_angle, cosine] = of_square(q);
  const Certified<double> aside = sine_over_angle * angle / r;
  return kept(Bounded{x * aside, y * aside, cosine}, column, row);
}

// θ = ω|y|. There is a ray where θ < π/2: end_of_angles is the greatest number below π².
std::optional<ApproximateDirection> DirectionModel::in_field_of_view(std::uint32_t column,
                                                                     std::uint32_t row) const {
  constexpr double right_angle_squared = lens::end_of_angles / 4;
  static_assert(right_angle_squared < end_of_series);
  const auto [x_value, y_value] = plane_.at(column + 0.5, row + 0.5);
  const Certified<double> x{x_value, plane_.error()}, y{y_value, plane_.error()};
  const Certified<double> across = omega_ * x, down = omega_ * y;
  const Certified<double> q = across * across + down * down;
  const Interval enclosed = enclose(q);
  if (enclosed.lower > right_angle_squared) return std::nullopt;
  if (!(enclosed.upper <= right_angle_squared)) return exactly_at(column, row);
  const auto [sine_over_angle, cosine] = of_square(q);
  return kept(Bounded{x * sine_over_angle, y * sine_over_angle, stretch_ * cosine}, column, row);
}

// An angle that errs by e moves sines and cosines by at most e. With errors of E and F of the
// factors, a product of numbers up to 1 errs by E + F + E·F and a rounding.
std::optional<ApproximateDirection> DirectionModel::turned(std::uint32_t column,
                                                           std::uint32_t row) const {
  const double e = plane_.error();
  if (!(e < 1)) return exactly_at(column, row);
  const auto [x, y] = plane_.at(column + 0.5, row + 0.5);
  const auto [sine, cosine] = of_turns(x);
  const double of_x = (2 * std::numbers::pi * e + turn_rounding) * up;
  ApproximateDirection direction{{sine, y, cosine}, std::max(of_x, e)};
  if (model_ == LensModel::equirectangular) {
    if (std::abs(y) - e > 0.5) return std::nullopt;
    if (!((std::abs(y) + e) * up < 0.5)) return exactly_at(column, row);
    const auto [down, level] = of_turns(y / 2);
    const double of_y = (std::numbers::pi * e + turn_rounding) * up;
    direction = {{level * sine, down, level * cosine}, (of_x + of_y + of_x * of_y + u) * up};
  }
  return kept(direction, column, row);
}

namespace {

/// The middles of intervals, and half of the greatest width.
ApproximateDirection middle_of(const std::array<Interval, 3>& box) {
  ApproximateDirection direction{{}, underflow};
  for (std::size_t k = 0; k < 3; ++k) {
    direction.d[k] = box[k].lower / 2 + box[k].upper / 2;
    direction.error = std::max(direction.error, (box[k].upper - box[k].lower) * up + underflow);
  }
  return direction;
}

/// The same direction, times a power of two that brings its greatest component to about 1.
std::array<DyadicInterval, 3> scaled_to_one(std::array<DyadicInterval, 3> d) {
  Dyadic greatest;
  for (const auto& [low, high] : d) greatest = std::max({greatest, abs(low), abs(high)});
  for (auto& [low, high] : d) {
    low = low.scaled(-greatest.top());
    high = high.scaled(-greatest.top());
  }
  return d;
}

}  // namespace

std::optional<ApproximateDirection> DirectionModel::exactly_at(std::uint32_t column,
                                                               std::uint32_t row) const {
  const auto exact = preimages_.of_pixel(column, row);
  if (!exact) return std::nullopt;
  if (const ExactVector3* const d = exact->rational()) {
    const auto [x, y, z] = lens::scaled_to_one(*d);
    return middle_of({enclose(x), enclose(y), enclose(z)});
  }
  const auto [x, y, z] = scaled_to_one(exact->enclosure(64));
  return middle_of({enclose(x), enclose(y), enclose(z)});
}

namespace {

struct Place {
  double x, y, error;
};

/// The place of a direction in a view; its error is +∞, or NaN, where none is known.
Place place_in(const ViewAxes& view, const ApproximateDirection& direction) {
  const double w = view.forward.of(direction.d);
  const double least = w - direction.error;
  Place place{view.right.of(direction.d) / w, view.down.of(direction.d) / w,
              std::numeric_limits<double>::infinity()};
  if (!(least > 0)) return place;
  const double size = greatest_size(place.x, place.y);
  const double by_components = direction.error == 0 ? 0 : direction.error * (1 + size) / least;
  place.error = (by_components + place_rounding * size) * up + underflow;
  return place;
}

bool is_tight(const Place& place) {
  return place.error <= loose_error * greatest_size(place.x, place.y) + underflow;
}

/// The view along the greatest component.
std::uint8_t view_along(const std::array<double, 3>& d) {
  std::uint8_t along = 0;
  for (std::size_t v = 1; v < all_views.size(); ++v)
    if (all_views[v].forward.of(d) > all_views[along].forward.of(d))
      along = static_cast<std::uint8_t>(v);
  return along;
}

/// A bit for each view in which the direction is not far from the middle; the exact one is then in
/// front of it, and its place below 9.
unsigned views_with(const ApproximateDirection& direction) {
  unsigned views = 0;
  for (std::size_t v = 0; v < all_views.size(); ++v) {
    const double w = all_views[v].forward.of(direction.d);
    const double most = most_in_one_view * w;
    if (w > 2 * direction.error && std::abs(all_views[v].right.of(direction.d)) <= most &&
        std::abs(all_views[v].down.of(direction.d)) <= most)
      views |= 1U << v;
  }
  return views;
}

/// The views that hold all samples.
unsigned common_views(std::span<const DirectionModel::Sample> samples) {
  unsigned views = (1U << all_views.size()) - 1;
  for (const auto& sample : samples) views &= views_with(sample.direction);
  return views;
}

}  // namespace

std::array<PlacesInView, all_views.size()> find_places(const DirectionModel& model,
                                                       const TileGrid& grid, std::uint32_t tile,
                                                       const FoundPlaces& places,
                                                       std::span<std::uint8_t> views) {
  const PixelBox area = grid.area(tile);
  std::ranges::fill(places.x, no_number);
  std::ranges::fill(places.y, no_number);
  std::array<PlacesInView, all_views.size()> found;
  const std::vector<DirectionModel::Sample> samples = model.of_tile(tile);
  const unsigned common = model.looks_ahead() ? 1U : common_views(samples);
  const auto view_of = [common](const ApproximateDirection& direction) {
    return common != 0 ? static_cast<std::uint8_t>(std::countr_zero(common))
                       : view_along(direction.d);
  };
  for (const auto& [column, row, direction] : samples) {
    std::uint8_t v = view_of(direction);
    Place place = place_in(all_views[v], direction);
    if (!is_tight(place)) {
      const ApproximateDirection exact = *model.exactly_at(column, row);
      v = view_of(exact);
      place = place_in(all_views[v], exact);
    }
    const std::size_t i = TileShape::index(column - area.first_column, row - area.first_row);
    places.x[i] = place.x;
    places.y[i] = place.y;
    views[i] = v;
    PlacesInView& in_view = found[v];
    in_view.error = std::max(in_view.error, place.error);
    in_view.box.add({place.x, place.x, place.y, place.y});
    ++in_view.count;
  }
  return found;
}

}  // namespace fathom::fast
