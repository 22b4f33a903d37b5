#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/fast/setup/setup.h"
#include "fathom/fast/setup/setup_bounds.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/rounding.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double above(double x) {
  return std::nextafter(x, infinity);
}
double below(double x) {
  return std::nextafter(x, -infinity);
}

}  // namespace

// Orthographic: q = −D, so q ≤ −near, q ≥ −far, and q < 0: −0 counts as "unknown". Perspective: a
// covered sample has D > 0 always; 1/far and 1/near are rounded, so the numbers next to them
// enclose them (far = ∞ gives 0 and near = 0 gives ∞, exact: no limit).
DepthRange depth_range(const Camera& camera) {
  if (is_orthographic(camera.projection)) {
    const double nearest = camera.near > 0 ? -camera.near : below(0.0);
    return {-camera.far, nearest, -camera.far, camera.near > 0 ? -camera.near : 0.0};
  }
  DepthRange range{-infinity, infinity, -infinity, infinity};
  if (camera.far < infinity) {
    range.inside_least = above(1 / camera.far);
    range.outside_least = below(1 / camera.far);
  }
  if (camera.near > 0) {
    range.inside_greatest = below(1 / camera.near);
    range.outside_greatest = above(1 / camera.near);
  }
  return range;
}

// Setups from exact forms, or from double-words: every coefficient is exact and rounded once.

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

using Word = DoubleWord<false>;

/// The least e with |x| < 2^e, as above.
long magnitude(const Word& x) {
  return x.hi == 0 ? std::numeric_limits<long>::min() / 2 : std::ilogb(x.hi) + 1L;
}

/// A function of column and row from a box's first sample, in double-words: a, b and c err by
/// error/X, error/Y and error, where samples are at most X and Y from there.
struct WideFunction {
  Word a, b, c;
  double error;
};

// The bound of a form holds for the value computed at any sample; at the first sample of the box
// this value is c. The bound would be no smaller if the form had only one term, a or b times the
// bound of the image's u or v, which is not less than X or Y. So it bounds the error of each of the
// three.
WideFunction from_first_sample(const Form<WordPair>& form, double u, double v) {
  const Word a = form.a, b = form.b, c = form.c;
  return {a, b, (c + b * v) + a * u, form.error};
}

WideFunction negated(const WideFunction& f) {
  return {-f.a, -f.b, -f.c, f.error};
}

// f − g − h. The bounds are 12ε of the sums of the terms' magnitudes; each coefficient is rounded
// twice, by ε times parts of those sums: by less than a quarter of the bounds.
WideFunction difference(const WideFunction& f, const WideFunction& g, const WideFunction& h) {
  return {f.a - g.a - h.a, f.b - g.b - h.b, f.c - g.c - h.c,
          setup_bounds::wide_difference * (f.error + g.error + h.error)};
}

double extent_of(const PixelBox& box) {
  // Samples up to 8 pixels beyond the box count too.
  return std::max(box.last_column - box.first_column, box.last_row - box.first_row) + 8.0;
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
  const double extent = extent_of(box);
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

  const LinearForm& numerator = perspective ? t.weight : t.depth_numerator;
  const LinearForm& denominator = perspective ? t.depth_numerator : t.weight;
  const Dyadic& divisor = denominator.coefficients()[2];
  const auto coefficient = [&](const Dyadic& x) {
    const double q = round_to_binary64(Ratio(x, divisor));
    return perspective ? q : -q;
  };
  setup.q_a = coefficient(numerator.coefficients()[0]);
  setup.q_b = coefficient(numerator.coefficients()[1]);
  setup.q_c = coefficient(numerator.at(origin_u, origin_v));
  const double S = std::abs(setup.q_c) + (std::abs(setup.q_a) + std::abs(setup.q_b)) * extent;
  if (S < setup_bounds::greatest_q) {
    setup.q_error = (setup_bounds::exact_q_error * S + 0x1p-100) * setup_bounds::q_room;
  } else {
    setup.q_a = setup.q_b = setup.q_c = 0;
    setup.q_error = std::numeric_limits<double>::infinity();
  }
  return setup;
}

// Sample (x, y) from the box's first is covered where the weights e_A/S, e_B/S and e_C/S are
// positive and D = (n·t)/(n·d) is (certified_surface.h). S is n·d times a constant, so that is
// where the forms of the weights, turned by the sign of n·t, are positive; these are the edge
// functions times one positive number. q = (n·d)/(n·t).
//
// Rounding errs as for exact coefficients. In addition, the three coefficients of an edge function,
// each times its factor, err by `error` each (wide_edges.gappa.in). The coefficients of q are
// quotients, whose bounds are added up (wide_q.gappa.in).
std::optional<TriangleSetup> wide_setup(const WideForms& forms, std::uint32_t number,
                                        const PixelBox& box) {
  const Certified<Word> nt{forms.constant.value, forms.constant.error};
  const auto side = certain_sign(forms.constant.value, forms.constant.error);
  if (!side) return std::nullopt;
  TriangleSetup setup;
  setup.number = number;
  setup.column = box.first_column;
  setup.row = box.first_row;
  const double u = box.first_column + 0.5, v = box.first_row + 0.5;
  const double extent = extent_of(box);
  const long extent_bits = std::ilogb(extent) + 1;

  const WideFunction all = from_first_sample(forms.weights.divisor, u, v);
  const WideFunction B = from_first_sample(forms.weights.weights[0], u, v);
  const WideFunction C = from_first_sample(forms.weights.weights[1], u, v);
  const WideFunction edges[] = {difference(all, B, C), B, C};
  double greatest_error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const WideFunction f = *side < 0 ? negated(edges[i]) : edges[i];
    const long top =
        std::max({magnitude(f.a) + extent_bits, magnitude(f.b) + extent_bits, magnitude(f.c)});
    if (top < -1000) return std::nullopt;
    const auto scaled = [&](double x) { return std::ldexp(x, static_cast<int>(-top)); };
    setup.edge_a[i] = scaled(f.a.hi);
    setup.edge_b[i] = scaled(f.b.hi);
    setup.edge_c[i] = scaled(f.c.hi);
    greatest_error = std::max(greatest_error, scaled(f.error));
  }
  if (!(greatest_error <= setup_bounds::wide_limit)) return std::nullopt;
  setup.edge_error = setup_bounds::exact_edge_error + setup_bounds::wide_terms * greatest_error;

  const auto a = quotient<Word>({all.a, all.error / forms.u}, nt);
  const auto b = quotient<Word>({all.b, all.error / forms.v}, nt);
  const auto c = quotient<Word>({all.c, all.error}, nt);
  setup.q_a = a.value.hi;
  setup.q_b = b.value.hi;
  setup.q_c = c.value.hi;
  const double S = std::abs(setup.q_c) + (std::abs(setup.q_a) + std::abs(setup.q_b)) * extent;
  const double of_words = c.error + (a.error + b.error) * extent;
  if (!(S < setup_bounds::greatest_q && of_words < setup_bounds::greatest_q)) return std::nullopt;
  setup.q_error = (setup_bounds::exact_q_error * S + (of_words + 0x1p-100)) * setup_bounds::q_room;
  return setup;
}

std::optional<TriangleSetup> wide_setup(Referee& referee, std::uint32_t number,
                                        const PixelBox& box) {
  const auto forms = referee.wide_forms(number);
  return forms ? wide_setup(*forms, number, box) : std::nullopt;
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
