#pragma once

#include <array>
#include <vector>

#include "fathom/numeric/interval.h"

/// Exact signs for the painter's algorithm, for points (x, y, depth in the window).
namespace fathom::pipeline {

using Point3d = std::array<double, 3>;

/// The sign of det(b − a, c − a, p − a): mostly settled by a bound on the rounding of the
/// determinant in binary64, the rest by exact numbers.
Sign side_of_plane(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p);

/// Whether two convex polygons overlap in x and y by more than their boundaries.
bool projections_overlap(const std::vector<Point3d>& p, const std::vector<Point3d>& q);

/// The sign of the turn a → b → c in x and y.
Sign turn_in_window(const Point3d& a, const Point3d& b, const Point3d& c);

}  // namespace fathom::pipeline
