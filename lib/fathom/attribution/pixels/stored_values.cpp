#include "fathom/attribution/pixels/stored_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "fathom/numeric/unit_roundoff.h"

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

}  // namespace fathom::attribution
