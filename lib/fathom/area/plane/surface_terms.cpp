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

ExactVector3 localised(const LinearForm& form, const PlanePart& part) {
  const ExactVector3& l = form.coefficients();
  return {l[0], l[1], form.at(part.left, part.top)};
}

/// The edge functions of B and C, and their sum with that of A, in a cell's coordinates. At the
/// point where two lines cross, homogeneous with the weight turn(line, other), a form has the value
/// det(form, line, other); the weight cancels from β and γ.
class SurfaceForms {
 public:
  explicit SurfaceForms(const SurfaceOnPart& on)
      : b_(localised(on.surface.region[1], on.part)),
        c_(localised(on.surface.region[2], on.part)),
        sigma_(localised(on.surface.weight, on.part)) {}

  [[nodiscard]] SurfacePoint at(const HalfPlane& line, const HalfPlane& other) const {
    const ExactVector3 place = cross(line.exact(), other.exact());
    return {dot(b_, place), dot(c_, place), dot(sigma_, place)};
  }

 private:
  ExactVector3 b_, c_, sigma_;
};

// In the plane of (β, γ), with Green's theorem: 2∫∫ dβ dγ = Σ p × q, and
// 6∫∫ β dβ dγ = Σ (p × q)(β_p + β_q).
void add_term(SurfaceTerms& terms, const SurfacePoint& p, const SurfacePoint& q, bool reversed,
              const WantedTerms& wanted) {
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

void add_image_terms(SurfaceTerms& terms, const Boundary& boundary) {
  std::vector<Ratio> added = terms_of_area(boundary);
  std::move(added.begin(), added.end(), std::back_inserter(terms.image));
}

void add_surface_terms(SurfaceTerms& terms, const Boundary& boundary, const SurfaceOnPart& on,
                       const WantedTerms& wanted) {
  const SurfaceForms forms(on);
  for (const BoundarySegment& s : boundary) {
    add_term(terms, forms.at(*s.line, *s.from), forms.at(*s.line, *s.to), s.reversed, wanted);
  }
}

}  // namespace fathom::area
