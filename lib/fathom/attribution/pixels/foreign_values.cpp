#include "fathom/attribution/pixels/foreign_values.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// Where depths lie among a storage's codes.
class CodeScale {
 public:
  CodeScale(const Camera& camera, const RasterModel& model)
      : window_(window_depth(camera.projection, model.mapping, camera.near, camera.far)),
        codes_(is_unorm(model.storage) ? greatest_code(model.storage) : 0x1p24),
        least_(is_unorm(model.storage) ? 0 : 0.5) {}

  struct Place {
    double code = 0;   ///< not a whole number
    double error = 0;  ///< how far from there the code may be that was decoded
  };
  /// Nothing where codes are not told apart.
  [[nodiscard]] std::optional<Place> of(double depth) const {
    const double window = window_.of_depth(depth);
    if (!(window >= least_ && window <= 1)) return std::nullopt;
    const double moved = std::abs(window_.of_depth(depth * (1 + 4 * u)) - window);
    // As storage_error() of raster_depth.cpp has the decoding: four roundings of a window depth.
    return Place{window * codes_, codes_ * (4 * u + moved)};
  }

 private:
  WindowDepth window_;
  double codes_;  ///< to a window depth of 1
  double least_;
};

std::vector<double> sorted_depths(const OtherMap& other) {
  std::vector<double> depths;
  for (const double depth : other.depths) {
    if (std::isfinite(depth) && depth > 0) depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

/// Distinct depths in a range of codes, and how many may be there.
struct Range {
  double begin = 0, end = -1, error = 0;
  std::uint64_t depths = 0;

  [[nodiscard]] std::uint64_t too_many() const {
    const double most = std::ceil(end - begin + 2 * error) + 1;
    return static_cast<double>(depths) > most ? depths - static_cast<std::uint64_t>(most) : 0;
  }
};

}  // namespace

std::uint64_t foreign_values(const Camera& camera, const OtherMap& other,
                             const RendererModel& model) {
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  const bool has_codes = raster != nullptr && raster->mapping == Mapping::opengl &&
                         !raster->written && !model.recorded;
  if (!has_codes) return 0;
  const CodeScale scale(camera, *raster);
  std::uint64_t foreign = 0;
  Range range;
  double last = 0;
  for (const double depth : sorted_depths(other)) {
    const std::optional<CodeScale::Place> place = scale.of(depth);
    if (!place) continue;
    const auto [code, error] = *place;
    if (error < 0.25) {
      foreign += std::abs(code - std::nearbyint(code)) > error ? 1 : 0;
      continue;
    }
    if (depth == last) continue;
    last = depth;
    if (!(code < range.end)) {
      foreign += range.too_many();
      range = {.begin = code, .end = code + std::max(64.0, 16 * error)};
    }
    range.error = std::max(range.error, error);
    ++range.depths;
  }
  return foreign + range.too_many();
}

}  // namespace fathom::attribution
