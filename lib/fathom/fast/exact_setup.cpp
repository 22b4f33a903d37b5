#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/fast/setup.h"
#include "fathom/fast/setup_bounds.h"
#include "fathom/numeric/rounding.h"

// Setups from exact forms: every coefficient is exact and rounded once.
namespace fathom::fast {
using namespace triangle;

namespace {

/// The least e with |x| < 2^e; below every other number's for 0.
long magnitude(const Dyadic& x) {
  if (x.is_zero()) return std::numeric_limits<long>::min() / 2;
  return x.top();
}

double rounded(const Dyadic& x) {
  return round_to_binary64(Ratio(x));
}

}  // namespace

// Edges are scaled by a power of two so that |c|, |a|·X, |b|·Y < 1, where X, Y ≤ 2^extent bound the
// local samples. Then the rounded coefficients err by 3u together, the two products by 2u, the two
// sums by 2.01u and 3.01u: 10.1u; underflow is below 2⁻¹⁰⁰⁰. 12u is used.
//
// q = w/n for a perspective camera, −n/w for an orthographic one, where D = n/w; the denominator is
// |Δ|, constant over the image. With S = |c| + |a|X + |b|Y the error is at most u·S for the
// coefficients, u·S for the products and 2.01u·S for the sums; 5u·S and a floor against underflow
// are used.
TriangleSetup exact_setup(const ProjectedTriangle& t, bool perspective, const PixelBox& box) {
  TriangleSetup setup;
  setup.number = t.number;
  setup.column = box.first_column;
  setup.row = box.first_row;
  const double origin_u = box.first_column + 0.5, origin_v = box.first_row + 0.5;
  // Samples up to 8 pixels beyond the box count too.
  const double extent =
      std::max(box.last_column - box.first_column, box.last_row - box.first_row) + 8.0;
  const long extent_bits = std::ilogb(extent) + 1;

  for (std::size_t i = 0; i < 3; ++i) {
    const ExactVector3& l = t.edges[i].coefficients();
    const Dyadic c = t.edges[i].at(origin_u, origin_v);
    const long scale =
        std::max({magnitude(l[0]) + extent_bits, magnitude(l[1]) + extent_bits, magnitude(c)});
    setup.edge_a[i] = rounded(l[0].scaled(-scale));
    setup.edge_b[i] = rounded(l[1].scaled(-scale));
    setup.edge_c[i] = rounded(c.scaled(-scale));
  }
  setup.edge_error = setup_bounds::exact_edge_error;

  const ImageForm& numerator = perspective ? t.weight : t.depth_numerator;
  const ImageForm& denominator = perspective ? t.depth_numerator : t.weight;
  const Dyadic& divisor = denominator.coefficients()[2];
  const auto coefficient = [&](const Dyadic& x) {
    const double q = round_to_binary64(Ratio(x, divisor));
    return perspective ? q : -q;
  };
  setup.q_a = coefficient(numerator.coefficients()[0]);
  setup.q_b = coefficient(numerator.coefficients()[1]);
  setup.q_c = coefficient(numerator.at(origin_u, origin_v));
  const double S = std::abs(setup.q_c) + (std::abs(setup.q_a) + std::abs(setup.q_b)) * extent;
  if (S < 0x1p100) {
    setup.q_error = (setup_bounds::exact_q_error * S + 0x1p-100) * setup_bounds::q_room;
  } else {
    setup.q_a = setup.q_b = setup.q_c = 0;
    setup.q_error = std::numeric_limits<double>::infinity();
  }
  return setup;
}

// The constants become the values at the first sample of the part; all magnitudes are those of
// exact_setup(), whose bounds are about half of what is needed.
TriangleSetup moved_to(const TriangleSetup& s, const PixelBox& part) {
  TriangleSetup moved = s;
  const double x = static_cast<double>(part.first_column) - s.column;
  const double y = static_cast<double>(part.first_row) - s.row;
  moved.column = part.first_column;
  moved.row = part.first_row;
  for (std::size_t i = 0; i < 3; ++i) {
    moved.edge_c[i] = s.edge_b[i] * y + (s.edge_a[i] * x + s.edge_c[i]);
  }
  moved.q_c = s.q_b * y + (s.q_a * x + s.q_c);
  moved.edge_error *= setup_bounds::moved_share;
  moved.q_error *= setup_bounds::moved_share;
  return moved;
}

}  // namespace fathom::fast
