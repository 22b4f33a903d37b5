#include <cmath>
#include <limits>

#include "fathom/attribution/pixels/stored_values.h"

namespace fathom::attribution {
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

}  // namespace fathom::attribution
