#pragma once

#include <cstdint>
#include <vector>

namespace fathom::studies {

/// `count` depths from near to far, both included, evenly spaced; the ends are exact.
/// Fails    UsageError for fewer than two, or more than 10 million.
std::vector<double> linear_samples(double near, double far, std::uint32_t count);

/// The same, evenly spaced in the logarithm.
std::vector<double> logarithmic_samples(double near, double far, std::uint32_t count);

}  // namespace fathom::studies
