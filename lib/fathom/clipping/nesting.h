#pragma once

#include <string>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"

namespace fathom::clipping {

/// For each ring the number of others that it lies in: even for outlines, odd for holes. Of
/// identical rings a later one lies in an earlier one.
/// Fails    InputError "SIDE rings M and N cross at (x, y)". The rings must be simple.
std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side);

}  // namespace fathom::clipping
