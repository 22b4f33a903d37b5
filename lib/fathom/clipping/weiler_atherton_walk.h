#pragma once

#include <vector>

#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton.h"

/// Weiler–Atherton, step 3: the walk.
namespace fathom::clipping {

/// A piece of the result's border, directed so that the result lies to its left.
template <class Number>
struct BorderEdge {
  Point2<Number> from, to;
  Border along;
};

/// Closed walks that together run along every edge once. If several edges leave a point, the walk
/// takes the first one clockwise from where it came: the one that bounds, together with the edge by
/// which it came, the same wedge of the result. So pieces that only touch are walked separately.
///
/// Walks start from the first edges, in the given order.
/// Fails    InputError if no edge leads on; over Rational that cannot happen.
template <class Number>
std::vector<std::vector<BorderEdge<Number>>> walk(const std::vector<BorderEdge<Number>>& edges);

/// The rings of a walk, which is taken apart where it passes through a point again, so that each
/// ring is simple.
template <class Number>
Rings<Number> simple_rings(const std::vector<BorderEdge<Number>>& closed_walk);

}  // namespace fathom::clipping
