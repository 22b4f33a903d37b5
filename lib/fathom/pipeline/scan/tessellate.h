#pragma once

#include <array>
#include <vector>

#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/polygon_tests.h"

namespace fathom::pipeline {

/// The inside of a polygon by the even-odd rule, concave or with holes, as triangles that do not
/// overlap: a constrained Delaunay triangulation of its outlines. Where outlines cross, the
/// crossing becomes a corner; otherwise no corner is added. Each triangle runs counter-clockwise
/// with y up, clockwise as seen with y down.
///
/// Exact    every test and every crossing.
/// Source   CGAL, 2D Triangulations.
std::vector<std::array<Point<Exact>, 3>> tessellate(const Rings<Exact>& polygon);

}  // namespace fathom::pipeline
