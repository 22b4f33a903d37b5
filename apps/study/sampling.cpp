#include "apps/study/sampling.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

template <class At>
std::vector<double> samples(double near, double far, std::uint32_t count, const At& at) {
  if (count < 2 || count > 10000000) {
    throw UsageError("--samples: " + std::to_string(count) + " is not from 2 to 10000000");
  }
  std::vector<double> depths(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    depths[i] = std::clamp(at(static_cast<double>(i) / (count - 1)), near, far);
  }
  depths.front() = near;
  depths.back() = far;
  return depths;
}

}  // namespace

std::vector<double> linear_samples(double near, double far, std::uint32_t count) {
  return samples(near, far, count, [&](double share) { return std::lerp(near, far, share); });
}

std::vector<double> logarithmic_samples(double near, double far, std::uint32_t count) {
  const double from = std::log2(near), to = std::log2(far);
  return samples(near, far, count,
                 [&](double share) { return std::exp2(std::lerp(from, to, share)); });
}

}  // namespace fathom::studies
