#include <fathom/lens/preimages.h>

// The lens x_d = x·(1 + q) takes x = ½ to ⅝.
bool use_lens() {
  const fathom::Projection projection;
  const fathom::lens::Preimages preimages(projection, {fathom::LensModel::simple_radial, {1}});
  const auto d = preimages.of(fathom::Dyadic(0.625), fathom::Dyadic());
  return d && d->sign_of(fathom::ExactVector3{1.0, 0.0, -0.5}) == fathom::Sign::zero;
}
