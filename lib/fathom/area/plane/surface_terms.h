#pragma once

#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/plane/certain_sides.h"

/// Areas of boundaries as sums over their segments, on the image and on the surface itself.
namespace fathom::area {

/// Terms of which the sum is a quantity. They are kept apart, because their exact sum has a long
/// denominator, and an enclosure of it mostly settles how it rounds.
using Terms = std::vector<Ratio>;

/// Quantities of a part of a triangle A, B, C. A point of the triangle is A + β(B − A) + γ(C − A).
struct SurfaceTerms {
  /// The area on the image, in pixels.
  Terms image;
  /// The part's share of the area of the triangle, on the surface: 2∫∫ dβ dγ, or minus that if the
  /// triangle's corners go round the other way.
  Terms share;
  /// 6∫∫ β dβ dγ and 6∫∫ γ dβ dγ, with that sign.
  Terms beta, gamma;
};

/// Which of them are wanted.
struct WantedTerms {
  bool image = true, share = false, moments = false;
  [[nodiscard]] bool on_surface() const { return share || moments; }
};

/// Where quantities on a surface come from: the surface, on the image.
struct SurfaceOnPart {
  const SurfaceRegion& surface;
  /// The coordinates of lines begin at its left top corner.
  const PlanePart& part;
};

/// Adds the terms of the area on the image that a boundary encloses.
void add_image_terms(SurfaceTerms& terms, const Boundary& boundary);
/// Adds the terms on the surface.
void add_surface_terms(SurfaceTerms& terms, const Boundary& boundary, const SurfaceOnPart& on,
                       const WantedTerms& wanted);

}  // namespace fathom::area
