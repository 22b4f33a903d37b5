#pragma once

#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/plane/certain_sides.h"

/// Areas of boundaries as sums over their segments, on the image and on the surface itself.
namespace fathom::area {

/// Terms whose sum is a quantity. They are not added at once: the exact sum has a long denominator,
/// and an enclosure of the sum mostly decides its rounding.
using Terms = std::vector<Ratio>;

/// Quantities of a part of a triangle A, B, C. A point of the triangle is A + β(B − A) + γ(C − A).
struct SurfaceTerms {
  /// The area on the image, in pixels.
  Terms image;
  /// The part's share of the area of the triangle, on the surface: 2∫∫ dβ dγ, with a minus sign if
  /// the triangle's corners go round the other way.
  Terms share;
  /// 6∫∫ β dβ dγ and 6∫∫ γ dβ dγ, with that sign.
  Terms beta, gamma;
};

/// The quantities to compute.
struct WantedTerms {
  bool image = true, share = false, moments = false;
  [[nodiscard]] bool on_surface() const { return share || moments; }
};

/// A surface and the part of the image in which it is measured.
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
