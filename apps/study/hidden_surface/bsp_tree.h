#pragma once

#include "apps/study/hidden_surface/sight.h"

namespace fathom::studies {

/// How a tree computes the corners at which it cuts polygons, on which side of a plane a corner
/// lies, and whether a ray meets a piece.
enum class TreeArithmetic {
  binary64,        ///< all in binary64
  exact_outlines,  ///< pieces in binary64, but whether a ray meets a piece is decided exactly
  exact            ///< all exact, by CGAL's lazy rational numbers
};

/// Hidden surfaces by a tree of planes: the first polygon's plane divides the others, which are cut
/// where they pass through it, into those before and those behind, and so on; painted in the order
/// behind, on the plane, before, as seen from the eye. The tree does not depend on the eye.
/// In binary64 a corner on a cutting plane may come out beside it, so pieces get edges shorter than
/// rounding errors; on which side of such an edge a pixel lies is noise, and pixels become wrong.
/// Source   [FKN80]
Sight bsp_tree(const Scene& scene, const Camera& camera,
               TreeArithmetic arithmetic = TreeArithmetic::binary64);

}  // namespace fathom::studies
