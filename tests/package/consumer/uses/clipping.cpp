#include <fathom/clipping/exact_kernel.h>
#include <fathom/clipping/rings.h>

bool use_clipping() {
  using fathom::clipping::Rational;
  const fathom::clipping::Ring<Rational> triangle{{0, 0}, {1, 0}, {0, 1}};
  return signed_area(triangle) == Rational(1, 2);
}
