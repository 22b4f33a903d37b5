#include "fathom/attribution/pixels/stored_values.h"

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

}  // namespace fathom::attribution
