#include "fathom/attribution/pixels/stored_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

struct Values {
  const Truth& truth;
  const OtherMap& other;

  std::unique_ptr<StoredValues> operator()(const RasterModel& model) const {
    return raster_values(truth, other, model);
  }
  std::unique_ptr<StoredValues> operator()(const RayModel& /*model*/) const {
    return ray_values(other);
  }
};

}  // namespace

std::unique_ptr<StoredValues> stored_values(const Truth& truth, const OtherMap& other,
                                            const RendererModel& model) {
  auto values = std::visit(Values{truth, other}, model.kind);
  const bool is_recorded = model.recorded && other.windows.empty();
  return is_recorded ? recorded_values(std::move(values), other, *model.recorded)
                     : std::move(values);
}

Interval rounded_to_binary32(const Interval& depths) {
  const auto [lower, upper] = depths;
  return {lower - 2 * unit_roundoff<float> * std::abs(lower),
          upper == std::numeric_limits<double>::infinity()
              ? upper
              : upper + 2 * unit_roundoff<float> * std::abs(upper)};
}

double binary32_spacing(double x) {
  if (x == 0 || !std::isfinite(x)) return 0x1p-149;
  return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
}

double storage_step(const RasterModel& model, double window) {
  double resolved = binary32_spacing(window);
  if (model.written && is_logarithmic(model.written->mapping)) {
    const double scale = model.written->scale;
    resolved = std::max(resolved, std::abs(scale) * log2_error(window / scale));
  } else if (!model.written && model.mapping == Mapping::opengl) {
    resolved = std::max(resolved, 0x1p-24);  // z_ndc/2 + 1/2: as numbers of about a half
  }
  if (model.storage == Storage::float16) return 0x1p13 * resolved;
  if (!is_unorm(model.storage)) return resolved;
  return std::max(resolved, 1.0 / greatest_code(model.storage));
}

namespace {

/// Recorded depths: values that a renderer may have made, as they may be read back.
class RecordedValues final : public StoredValues {
 public:
  RecordedValues(std::unique_ptr<StoredValues> made, const OtherMap& other,
                 const RecordedDepth& recorded)
      : made_(std::move(made)), depths_(other.depths), recorded_(recorded) {}

  [[nodiscard]] Interval interval(const Fragment& f) const override {
    return recorded_.read_back(made_->interval(f));
  }
  [[nodiscard]] double exact(const Fragment& f) const override { return made_->exact(f); }
  [[nodiscard]] double limit(double value) const override {
    const double depth = made_->limit(value);
    return std::isfinite(depth) ? recorded_.read_back({depth, depth}).upper : depth;
  }
  [[nodiscard]] double other(std::size_t pixel) const override { return depths_[pixel]; }
  [[nodiscard]] Interval as_depths(const Fragment& f) const override { return interval(f); }

  [[nodiscard]] bool is_background(std::size_t pixel) const override {
    return depths_[pixel] == std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool surfaces_may_look_like_background() const override { return false; }

  [[nodiscard]] bool is_nearest(std::size_t pixel, double depth) const override {
    return steps_off(pixel, depth) < 0.5;
  }
  [[nodiscard]] bool is_neighbour(std::size_t pixel, double depth) const override {
    return steps_off(pixel, depth) < 1.5;
  }
  [[nodiscard]] double steps(const Fragment& f, double depth) const override {
    const Interval depths = interval(f);
    const double width = recorded_.exact(depths.upper) - recorded_.exact(depths.lower);
    return std::abs(width) / recorded_.step_at(recorded_.exact(depth));
  }
  [[nodiscard]] std::optional<BiasSteps> bias_steps(std::size_t /*pixel*/,
                                                    const Fragment& /*f*/) const override {
    return std::nullopt;
  }

 private:
  /// From the exact depth, rounded to the recorded precision.
  [[nodiscard]] double steps_off(std::size_t pixel, double depth) const {
    const double expected = recorded_.rounded(recorded_.exact(depth));
    return std::abs(recorded_.exact(depths_[pixel]) - expected) / recorded_.step_at(expected);
  }

  std::unique_ptr<StoredValues> made_;
  const std::vector<double>& depths_;
  RecordedDepth recorded_;
};

}  // namespace

std::unique_ptr<StoredValues> recorded_values(std::unique_ptr<StoredValues> made,
                                              const OtherMap& other,
                                              const RecordedDepth& recorded) {
  return std::make_unique<RecordedValues>(std::move(made), other, recorded);
}

namespace {

/// Of a ray tracer: depths, as they are.
class RayValues final : public StoredValues {
 public:
  explicit RayValues(const OtherMap& other) : depths_(other.depths) {}

  [[nodiscard]] Interval interval(const Fragment& f) const override { return f.value; }
  [[nodiscard]] double exact(const Fragment& f) const override { return f.exact; }
  [[nodiscard]] double limit(double value) const override { return value; }
  [[nodiscard]] double other(std::size_t pixel) const override { return depths_[pixel]; }
  [[nodiscard]] Interval as_depths(const Fragment& f) const override {
    return rounded_to_binary32(f.value);
  }

  [[nodiscard]] bool is_background(std::size_t pixel) const override {
    return depths_[pixel] == std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool surfaces_may_look_like_background() const override { return false; }

  [[nodiscard]] bool is_nearest(std::size_t pixel, double depth) const override {
    return static_cast<float>(depths_[pixel]) == static_cast<float>(depth);
  }
  [[nodiscard]] bool is_neighbour(std::size_t pixel, double depth) const override {
    return std::abs(depths_[pixel] - depth) <= binary32_spacing(depth);
  }
  [[nodiscard]] double steps(const Fragment& f, double depth) const override {
    return (f.value.upper - f.value.lower) / binary32_spacing(depth);
  }
  [[nodiscard]] std::optional<BiasSteps> bias_steps(std::size_t /*pixel*/,
                                                    const Fragment& /*f*/) const override {
    return std::nullopt;
  }

 private:
  const std::vector<double>& depths_;
};

}  // namespace

std::unique_ptr<StoredValues> ray_values(const OtherMap& other) {
  return std::make_unique<RayValues>(other);
}

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
    return other_.windows[pixel] == (window_.reversed() ? 0 : 1);  // the clear value of the buffer
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
  WindowDepth window_;  ///< of the stored depths
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
