#include "fathom/area/plane/surface_terms.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace fathom::area {
namespace {

/// The place on a surface of a point of the image: β and γ times σ, and σ.
struct SurfacePoint {
  Dyadic b, c, sigma;
};

/// The edge functions of B and C, and their sum with that of A, in a cell's coordinates. At the
/// point where two lines cross, homogeneous with the weight turn(line, other), a form has the value
/// det(form, line, other); the weight cancels from β and γ.
class SurfaceForms {
 public:
  SurfaceForms(const ImageCell& cell, const SurfaceRegion& surface)
      : b_(cell.localised(surface.region[1])),
        c_(cell.localised(surface.region[2])),
        sigma_(cell.localised(surface.weight)) {}

  [[nodiscard]] SurfacePoint at(const HalfPlane& line, const HalfPlane& other) const {
    const ExactVector3 place = cross(line.exact(), other.exact());
    return {dot(b_, place), dot(c_, place), dot(sigma_, place)};
  }

 private:
  ExactVector3 b_, c_, sigma_;
};

// In the plane of (β, γ), with Green's theorem: 2∫∫ dβ dγ = Σ p × q, and
// 6∫∫ β dβ dγ = Σ (p × q)(β_p + β_q).
void add_surface_terms(SurfaceTerms& terms, const SurfacePoint& p, const SurfacePoint& q,
                       bool reversed, const WantedTerms& wanted) {
  Dyadic product = p.b * q.c - p.c * q.b;
  if (product.is_zero()) return;
  if (reversed) product = -product;
  const Dyadic weight = p.sigma * q.sigma;
  if (wanted.moments) {
    const Dyadic squared = weight * weight;
    terms.beta.emplace_back(product * (p.b * q.sigma + q.b * p.sigma), squared);
    terms.gamma.emplace_back(product * (p.c * q.sigma + q.c * p.sigma), squared);
  }
  terms.share.emplace_back(std::move(product), weight);
}

}  // namespace

void add_terms(SurfaceTerms& terms, const Boundary& boundary, const ImageCell& cell,
               const SurfaceRegion& surface, const WantedTerms& wanted) {
  if (wanted.image) {
    std::vector<Ratio> added = terms_of_area(boundary);
    std::move(added.begin(), added.end(), std::back_inserter(terms.image));
  }
  if (!wanted.share && !wanted.moments) return;
  const SurfaceForms forms(cell, surface);
  for (const BoundarySegment& s : boundary) {
    add_surface_terms(terms, forms.at(*s.line, *s.from), forms.at(*s.line, *s.to), s.reversed,
                      wanted);
  }
}

}  // namespace fathom::area
