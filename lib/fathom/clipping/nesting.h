#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/numbered_points.h"
#include "fathom/clipping/points.h"

/// Which ring lies in which, by one sweep over all edges.
namespace fathom::clipping {

/// For each ring the number of others that it lies in: even for outlines, odd for holes. Of
/// identical rings a later one lies in an earlier one.
/// Cost     n log n, and the pairs of rings that share an edge
/// Fails    InputError "SIDE rings M and N cross at (x, y)". The rings must be simple.
std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side);

/// For each ring that runs clockwise the outline (a ring that runs counter-clockwise) of the
/// polygon that it is a hole of; nullopt for outlines, and where rounding has left a hole without
/// one. Rings are simple and touch at most in points.
/// Cost     n log n
std::vector<std::optional<std::size_t>> outlines_around(const NumberedRings& rings,
                                                        const PointOrder& points);

}  // namespace fathom::clipping
