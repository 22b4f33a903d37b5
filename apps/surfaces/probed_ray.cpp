#include "apps/surfaces/probed_ray.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fathom/lens/no_ray.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/rounding.h"

namespace fathom::app {
namespace {

constexpr int digits = 25;
/// More than `digits` decimal digits.
constexpr long bits = 128;

/// The middles of the components over the greatest one.
std::array<Ratio, 3> scaled(const std::array<DyadicInterval, 3>& enclosure) {
  std::array<Dyadic, 3> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (enclosure[k].low + enclosure[k].high).scaled(-1);
  const Dyadic greatest = std::max({abs(middle[0]), abs(middle[1]), abs(middle[2])});
  return {Ratio(middle[0], greatest), Ratio(middle[1], greatest), Ratio(middle[2], greatest)};
}

}  // namespace

std::optional<ProbedRay> ProbedRay::of(const Camera& camera, std::uint32_t column,
                                       std::uint32_t row) {
  if (!bends_rays(camera.projection)) return std::nullopt;
  const lens::Preimages preimages(camera.projection, *camera.projection.lens);
  ProbedRay ray;
  ray.lens_ = name_of(camera.projection.lens->model);
  ray.disc_ = preimages.disc();
  const auto d = preimages.of_pixel(column, row);
  if (!d) {
    ray.why_none_ = lens::why_no_ray(camera.projection, column, row);
    return ray;
  }
  const std::array<Ratio, 3> direction = scaled(d->enclosure(bits));
  std::array<double, 3> rounded{};
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction_[k] = to_decimal(direction[k], digits);
    rounded[k] = round_to_binary64(direction[k]);
  }
  ray.degrees_ =
      std::atan2(std::hypot(rounded[0], rounded[1]), rounded[2]) * 180 / std::numbers::pi;
  return ray;
}

std::string ProbedRay::text() const {
  std::string lines =
      why_none_.empty()
          ? fmt::format("ray     ({}, {}, {})\n        {:.6f} degrees from the axis\n",
                        direction_[0], direction_[1], direction_[2], degrees_)
          : fmt::format("ray     none: {}\n", why_none_);
  lines += fmt::format("lens    {}", lens_);
  if (std::isfinite(disc_)) lines += fmt::format(", folds beyond x^2 + y^2 = {}", disc_);
  return lines + "\n";
}

nlohmann::ordered_json ProbedRay::json() const {
  nlohmann::ordered_json json{{"lens", lens_}};
  if (std::isfinite(disc_)) json["lens_disc"] = disc_;
  if (!why_none_.empty()) {
    json["none_because"] = why_none_;
    return json;
  }
  json["direction"] = direction_;
  json["degrees_from_axis"] = degrees_;
  return json;
}

}  // namespace fathom::app
