#include "fathom/attribution/background.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Number and share of the empty pixels that must agree.
constexpr std::uint64_t least_pixels = 16;
constexpr double least_share = 0.5;

/// Whether neither the pixel nor any of its neighbours shows a surface.
bool is_clear(const Truth& truth, std::uint32_t column, std::uint32_t row) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  for (std::uint32_t y = row == 0 ? 0 : row - 1; y <= row + 1 && y < height; ++y) {
    for (std::uint32_t x = column == 0 ? 0 : column - 1; x <= column + 1 && x < width; ++x) {
      if (truth.triangles[std::size_t{y} * width + x] != no_surface) return false;
    }
  }
  return true;
}

/// How often each value stands where nothing is seen; NaN counts as one value.
struct Census {
  std::unordered_map<double, std::uint64_t> counts;
  std::uint64_t nan = 0, total = 0;
};

Census census_of(const Truth& truth, const OtherMap& other) {
  Census census;
  for (std::uint32_t y = 0; y < truth.camera.height; ++y) {
    for (std::uint32_t x = 0; x < truth.camera.width; ++x) {
      if (!is_clear(truth, x, y)) continue;
      const double value = other.values[std::size_t{y} * truth.camera.width + x];
      ++census.total;
      std::isnan(value) ? ++census.nan : ++census.counts[value];
    }
  }
  return census;
}

/// The background's value, if most agree on it.
std::optional<double> agreed(const Census& census) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t most = census.nan;
  for (const auto& [v, count] : census.counts) {
    if (count > most || (count == most && v < value)) {
      value = v;
      most = count;
    }
  }
  const bool enough = most >= least_pixels &&
                      static_cast<double>(most) >= least_share * static_cast<double>(census.total);
  return enough ? std::optional(value) : std::nullopt;
}

/// "0", "NaN", "100, the depth of the far plane".
std::string described(double value, const Camera& camera) {
  if (std::isnan(value)) return "NaN";
  std::string text = fmt::format("{:.9g}", value);
  if (camera.far < infinity && std::abs(value - camera.far) <= 1e-5 * camera.far) {
    return text + ", the depth of the far plane";
  }
  if (value == double{std::numeric_limits<float>::max()}) return text + ", the greatest binary32";
  return text;
}

}  // namespace

KnownBackground known_background(const Truth& truth, const OtherMap& other) {
  const StandardArithmetic standard;
  KnownBackground known{other, std::nullopt};
  if (other.values.size() != truth.depths.size()) return known;
  const std::optional<double> value = agreed(census_of(truth, other));
  if (!value) return known;
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    const double v = other.values[i];
    const bool is_background = v == *value || !std::isfinite(v);
    known.map.depths[i] = is_background ? infinity : v;
    pixels += is_background ? 1 : 0;
  }
  if (*value != infinity) {
    known.note = Finding{
        "background",
        fmt::format("the background is stored as {}", described(*value, truth.camera)), pixels};
  }
  return known;
}

}  // namespace fathom::attribution
