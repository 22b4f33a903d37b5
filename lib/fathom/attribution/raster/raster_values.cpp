#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/pixels/stored_values.h"
#include "fathom/attribution/raster/matrix_roundings.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of a rasterizer: window depths, or depths that were decoded from them.
class RasterValues final : public StoredValues {
 public:
  RasterValues(const Truth& truth, const OtherMap& other, const RasterModel& model)
      : other_(other),
        model_(model),
        window_(window_depth(truth.camera.projection.model, model.stored_mapping(),
                             truth.camera.near, truth.camera.far)),
        sign_(window_.reversed() ? -1 : 1),
        roundings_(truth.camera, model, truth.mesh) {}

  [[nodiscard]] Interval interval(const Fragment& f) const override {
    return has_windows() ? f.value : as_depths(f);
  }
  [[nodiscard]] double exact(const Fragment& f) const override {
    return has_windows() ? f.exact : depth_of(f.exact);
  }
  [[nodiscard]] double limit(double value) const override;
  [[nodiscard]] double other(std::size_t pixel) const override {
    return has_windows() ? sign_ * other_.windows[pixel] : other_.depths[pixel];
  }
  [[nodiscard]] Interval as_depths(const Fragment& f) const override {
    return rounded_to_binary32({depth_of(f.value.lower), depth_of(f.value.upper)});
  }

  [[nodiscard]] bool is_background(std::size_t pixel) const override {
    if (!has_windows()) return other_.depths[pixel] == infinity;
    return other_.windows[pixel] == (window_.reversed() ? 0 : 1);  // what the buffer is cleared to
  }
  [[nodiscard]] bool surfaces_may_look_like_background() const override { return has_windows(); }

  [[nodiscard]] bool is_nearest(std::size_t pixel, double depth) const override;
  [[nodiscard]] bool is_neighbour(std::size_t pixel, double depth) const override;
  [[nodiscard]] double steps(const Fragment& f, double depth) const override;
  [[nodiscard]] std::optional<BiasSteps> bias_steps(std::size_t pixel,
                                                    const Fragment& f) const override;

 private:
  [[nodiscard]] bool has_windows() const { return !other_.windows.empty(); }
  [[nodiscard]] double depth_of(double value) const;
  [[nodiscard]] double window_of(std::size_t pixel) const {
    return has_windows() ? other_.windows[pixel] : window_.of_depth(other_.depths[pixel]);
  }

  const OtherMap& other_;
  RasterModel model_;
  WindowDepth window_;  ///< of what is stored
  double sign_;         ///< of a window depth in a fragment's value
  MatrixRoundings roundings_;
};

/// Of a fragment's value. Window depths beyond the far plane's infinity are infinitely far.
double RasterValues::depth_of(double value) const {
  return std::isfinite(value) ? window_.to_depth(sign_ * value) : value;
}

double RasterValues::limit(double value) const {
  if (has_windows()) return value;
  const double depth = depth_of(value);
  return depth == infinity ? depth : depth + 2 * unit_roundoff<float> * std::abs(depth);
}

bool RasterValues::is_nearest(std::size_t pixel, double depth) const {
  if (!has_windows()) {
    return static_cast<float>(other_.depths[pixel]) == static_cast<float>(depth);
  }
  const double exact = window_.of_depth(depth) + model_.bias;
  if (!is_unorm(model_.storage)) return other_.windows[pixel] == static_cast<float>(exact);
  const double codes = greatest_code(model_.storage);
  return std::abs(other_.windows[pixel] * codes - std::nearbyint(exact * codes)) < 0.25;
}

bool RasterValues::is_neighbour(std::size_t pixel, double depth) const {
  const double exact = window_.of_depth(depth) + model_.bias;
  return std::abs(window_of(pixel) - exact) <= storage_step(model_, exact);
}

double RasterValues::steps(const Fragment& f, double depth) const {
  return (f.value.upper - f.value.lower) / storage_step(model_, window_.of_depth(depth));
}

/// Depths that were decoded are as coarse as binary32 is, where that is coarser than the storage.
std::optional<BiasSteps> RasterValues::bias_steps(std::size_t pixel, const Fragment& f) const {
  const double expected = sign_ * f.exact;
  const double depth = window_.to_depth(expected);
  double step = storage_step(model_, expected);
  if (!has_windows()) {
    const double next = depth + binary32_spacing(depth);
    step = std::max(step, std::abs(window_.of_depth(next) - expected));
  }
  return BiasSteps{(window_of(pixel) - expected) / step, roundings_.of_window(pixel, depth) / step};
}

}  // namespace

std::unique_ptr<StoredValues> raster_values(const Truth& truth, const OtherMap& other,
                                            const RasterModel& model) {
  return std::make_unique<RasterValues>(truth, other, model);
}

}  // namespace fathom::attribution
