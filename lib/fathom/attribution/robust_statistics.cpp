#include "fathom/attribution/robust_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

/// 1 / Φ⁻¹(3/4): half of a normal distribution lies within 1 / 1.4826 of its standard deviation.
constexpr double deviations_per_median_distance = 1.4826022185056018;

}  // namespace

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Location location_of(std::vector<double> values) {
  const StandardArithmetic standard;
  const double median = median_of(values);
  for (double& value : values) value = std::abs(value - median);
  return {.median = median, .spread = deviations_per_median_distance * median_of(values)};
}

}  // namespace fathom::attribution
