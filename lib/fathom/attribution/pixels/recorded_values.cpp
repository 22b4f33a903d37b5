#include <cmath>
#include <limits>
#include <utility>

#include "fathom/attribution/pixels/stored_values.h"

namespace fathom::attribution {
namespace {

/// Depths that were written down once more: what a renderer may have made, as it may be read back.
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
  /// From the exact depth, rounded to what is recorded.
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
