#pragma once

#include <vector>

#include "fathom/numeric/real.h"

/// Sums of many quotients, whose exact values have long denominators. They round by an enclosure
/// first; the exact sum is computed only if the enclosure does not decide.
namespace fathom {

/// The sum of the terms.
Real real_sum(std::vector<Ratio> terms);

/// The sum of `over` divided by the sum of `under`.
/// Needs    an `under` of which every term is positive.
Real real_quotient(std::vector<Ratio> over, std::vector<Ratio> under);

/// The quotients of the numbers of two enclosures.
/// Needs    an `under` of which both ends are positive.
Enclosure quotient(const Enclosure& over, const Enclosure& under);

}  // namespace fathom
