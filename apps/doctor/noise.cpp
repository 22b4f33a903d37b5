#include "apps/doctor/noise.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace fathom::doctor {
namespace {

/// With fewer neighbours chance may put too many on the same side.
constexpr std::uint64_t least_neighbours = 1000;
/// Of independent deviations the share is 0.5 with a deviation of at most 0.016.
constexpr double most_same_side = 0.6;
/// A right camera sees a surface at nearly all pixels that have a depth.
constexpr double least_compared = 0.9;
/// A greater spread hides every camera.
constexpr double most_spread = 0.25;

/// nullopt unless both depths are there.
std::optional<double> deviation_of(const Pair& pair, double depth_scale) {
  if (!std::isfinite(pair.stored) || !std::isfinite(pair.exact)) return std::nullopt;
  return pair.stored / depth_scale / pair.exact - 1;
}

}  // namespace

Noise noise_of(const std::vector<Pair>& pairs, double depth_scale) {
  std::vector<double> deviations;
  std::uint64_t stored = 0;
  for (const Pair& pair : pairs) {
    if (std::isfinite(pair.stored)) ++stored;
    if (const auto deviation = deviation_of(pair, depth_scale)) deviations.push_back(*deviation);
  }
  if (deviations.empty()) return {};
  const std::uint64_t compared = deviations.size();
  Noise noise{.deviation = attribution::location_of(std::move(deviations)),
              .compared = double(compared) / double(stored)};
  std::uint64_t neighbours = 0, same = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i].block != pairs[i - 1].block) continue;
    const auto one = deviation_of(pairs[i - 1], depth_scale);
    const auto next = deviation_of(pairs[i], depth_scale);
    if (!one || !next) continue;
    ++neighbours;
    const double median = noise.deviation.median;
    if ((*one < median) == (*next < median)) ++same;
  }
  if (neighbours >= least_neighbours) noise.same_side = double(same) / double(neighbours);
  return noise;
}

bool is_independent(const Noise& noise) {
  return noise.same_side <= most_same_side && noise.compared >= least_compared &&
         noise.deviation.spread <= most_spread &&
         std::abs(noise.deviation.median) <= noise.deviation.spread;
}

}  // namespace fathom::doctor
