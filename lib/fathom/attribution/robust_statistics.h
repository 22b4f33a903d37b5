#pragma once

#include <vector>

/// Statistics of residuals that a few outliers, such as pixels at silhouettes, do not change.
namespace fathom::attribution {

/// The median; of an even number of values the greater of the two in the middle. Reorders the
/// values.
///
/// Needs    at least one value.
double median_of(std::vector<double>& values);

/// Where values lie, and how far from there.
struct Location {
  double median = 0;
  /// The median distance from the median, as the standard deviation of the normal distribution
  /// with this median distance.
  double spread = 0;
};

/// Needs    at least one value.
Location location_of(std::vector<double> values);

}  // namespace fathom::attribution
