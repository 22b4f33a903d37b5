#include "apps/study/sweeps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

std::string joined(const DepthFormat& format, const char* separator) {
  return std::string(name_of(format.mapping)) + separator + std::string(name_of(format.storage));
}

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

DepthFormat format_between(double near, double far, Mapping mapping, Storage storage) {
  return {mapping, storage, near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : far};
}

bool is_projection(Mapping mapping) {
  return mapping <= Mapping::opengl;
}

std::string label_of(const DepthFormat& format) {
  return joined(format, " ");
}

std::string file_name_of(const DepthFormat& format) {
  return joined(format, "-");
}

std::vector<double> linear_samples(double near, double far, std::uint32_t count) {
  return samples(near, far, count, [&](double share) { return std::lerp(near, far, share); });
}

std::vector<double> logarithmic_samples(double near, double far, std::uint32_t count) {
  const double from = std::log2(near), to = std::log2(far);
  return samples(near, far, count,
                 [&](double share) { return std::exp2(std::lerp(from, to, share)); });
}

}  // namespace fathom::studies
