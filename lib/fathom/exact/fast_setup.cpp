#include "fathom/exact/fast_setup.h"

#include <algorithm>
#include <cmath>

// The bounds of this file, with u = 2⁻⁵³ (docs/error-analysis.md, "Triangles"). All magnitudes are
// between 2⁻¹⁰⁰ and 2¹⁰⁰ or differences of such, so nothing overflows; errors of underflow are
// below 2⁻¹⁰⁰⁰ and vanish in the terms u·L² and the floors of the vertices' bounds.
namespace fathom {
namespace {

constexpr double u = unit_roundoff;

double greatest_of(double a, double b, double c) {
  return std::max(a, std::max(b, c));
}
double least_of(double a, double b, double c) {
  return std::min(a, std::min(b, c));
}

double position_error(const ImageVertex& A, const ImageVertex& B, const ImageVertex& C) {
  return greatest_of(A.position_error, B.position_error, C.position_error);
}

/// The samples k + ½ of 0 ≤ k < count between low and high. first > last where there is none.
void samples_between(double low, double high, std::uint32_t count, std::uint32_t& first,
                     std::uint32_t& last) {
  const double from = low - 0.5, to = high - 0.5;
  const double greatest = static_cast<double>(count) - 1;
  first = 1;
  last = 0;
  if (!(from <= greatest) || !(to >= 0)) return;
  if (from > 0) {
    first = static_cast<std::uint32_t>(from);
    first += static_cast<double>(first) < from;
  } else {
    first = 0;
  }
  last = to >= greatest ? count - 1 : static_cast<std::uint32_t>(to);
}

/// Affine function c + a·x + b·y of a local sample.
struct Local {
  double a, b, c;
};

}  // namespace

// Differences of coordinates, M the greatest of them in magnitude: each differs from the exact one
// by at most d = 2e + uM. A difference of two products of such differences then errs by at most
// 4dM + 2d² for its factors and 2uM² + 2uM²(1 + u) ≤ 4.01uM² for its roundings.
std::optional<Sign> certified_orientation(const ImageVertex& A, const ImageVertex& B,
                                          const ImageVertex& C) {
  const double bu = B.u - A.u, bv = B.v - A.v, cu = C.u - A.u, cv = C.v - A.v;
  const double M =
      std::max(std::max(std::abs(bu), std::abs(bv)), std::max(std::abs(cu), std::abs(cv)));
  const double d = 2 * position_error(A, B, C) + u * M;
  const double bound = (4 * M + 2 * d) * d + 5 * u * M * M;
  const double doubled_area = bu * cv - bv * cu;
  if (doubled_area > bound) return Sign::positive;
  if (doubled_area < -bound) return Sign::negative;
  return std::nullopt;
}

// A covered sample lies in the triangle of the exact corners, so between the least and the greatest
// computed coordinate, moved outwards by the corners' error and by the roundings of the subtraction
// below and of the ½: 2u·(|coordinate| + 1) each, less than 2⁻⁵¹·(|coordinate| + 1) together.
PixelBox sample_box(const ImageVertex& A, const ImageVertex& B, const ImageVertex& C,
                    std::uint32_t width, std::uint32_t height) {
  const double e = position_error(A, B, C);
  const double left = least_of(A.u, B.u, C.u), right = greatest_of(A.u, B.u, C.u);
  const double top = least_of(A.v, B.v, C.v), bottom = greatest_of(A.v, B.v, C.v);
  const auto margin = [e](double coordinate) { return e + (std::abs(coordinate) + 1) * 0x1p-50; };
  PixelBox box;
  samples_between(left - margin(left), right + margin(right), width, box.first_column,
                  box.last_column);
  if (box.first_column > box.last_column) return box;
  samples_between(top - margin(top), bottom + margin(bottom), height, box.first_row, box.last_row);
  return box;
}

// Local coordinates: the origin is the sample of the box's first pixel, so that samples are exact
// integers. Corners p̂ are the computed ones minus the origin; L ≥ 1 bounds them and the samples.
// Each differs from the exact corner by at most δ = e + uL.
//
// Edges. E = (P − s) × (Q − s) = c + a·x + b·y with a = P_v − Q_v, b = Q_u − P_u,
// c = P_u·Q_v − P_v·Q_u. Factors are at most 2L, so moving P and Q by δ changes E by at most
// η = 8δL + 2δ² ≤ 8.01δL (δ ≤ 2⁻¹¹L). Roundings: a, b 2uL each, times L: 4uL²; c 4.01uL²; products
// 2·2uL²; sums 4.01uL² + 6.01uL²: together 22.1uL². Bound: 8.25δL + 24uL².
//
// q. Exactly, q(s) = q_A + β(q_B − q_A) + γ(q_C − q_A) with β = E_B/T, γ = E_C/T, T the doubled
// area. F is the same function for the corners p̂, q̂, in real arithmetic, T' its area. At a covered
// sample 0 ≤ β, γ, β + γ ≤ 1, so
//   |q − F| ≤ e_q + (|β − β'| + |γ − γ'|)·dq,  dq = max(|q̂_B − q̂_A|, |q̂_C − q̂_A|),
//   |β − β'| = |(E_B − E_B')/T' + β(T' − T)/T'| ≤ 4η/T' (T is the sum of three edge functions),
// together e_q + 8η·dq/T' ≤ e_q + 64.1δL·dq/T'.
// Rounding of F, in units of uL²·dq/T': the numerators of the gradient a_B·dB + a_C·dC err by 16.1
// each over |s − A| ≤ 2L: 64.2; 1/T̂ and the product, 2.01u·|gradient|·2L: 32.2; T̂ itself by
// 32.1uL², which scales F − q̂_A ≤ 1.55dq: 50.3; c: 20.3 and 2u|q_A|; the evaluation: 36.6 and
// 2u|q_A|. Together 203.6, and 4.1u|q_A|.
// The condition T̂ ≥ 16·(8.25δL + 24uL²) gives T' ≥ 0.91·T̂, so that 1.1/T̂ ≥ 1/T', and
// η/T' ≤ 0.069, so that |β'| + |γ'| ≤ 1.55 as used above. 1.1·64.1 ≤ 72, 1.1·203.6 ≤ 230.
bool certified_setup(const ImageVertex& A, const ImageVertex& B_given, const ImageVertex& C_given,
                     const PixelBox& box, TriangleSetup& setup) {
  const double origin_u = box.first_column + 0.5, origin_v = box.first_row + 0.5;
  double Au = A.u - origin_u, Av = A.v - origin_v;
  double Bu = B_given.u - origin_u, Bv = B_given.v - origin_v;
  double Cu = C_given.u - origin_u, Cv = C_given.v - origin_v;
  double qB = B_given.q, qC = C_given.q;
  double T = (Bu - Au) * (Cv - Av) - (Bv - Av) * (Cu - Au);
  if (T < 0) {  // the other way round
    std::swap(Bu, Cu);
    std::swap(Bv, Cv);
    std::swap(qB, qC);
    T = -T;
  }

  const double extent = std::max(box.last_column - box.first_column, box.last_row - box.first_row);
  const double L = std::max(std::max(extent, 1.0),
                            std::max(greatest_of(std::abs(Au), std::abs(Bu), std::abs(Cu)),
                                     greatest_of(std::abs(Av), std::abs(Bv), std::abs(Cv))));
  const double delta = position_error(A, B_given, C_given) + u * L;
  const double edge_error = (8.25 * delta + 24 * u * L) * L;
  if (!(T >= 16 * edge_error)) return false;

  setup.column = box.first_column;
  setup.row = box.first_row;
  setup.edge_error = edge_error;
  setup.edge_a = {Bv - Cv, Cv - Av, Av - Bv};
  setup.edge_b = {Cu - Bu, Au - Cu, Bu - Au};
  setup.edge_c = {Bu * Cv - Bv * Cu, Cu * Av - Cv * Au, Au * Bv - Av * Bu};

  const double inverse = 1 / T;
  const double dB = qB - A.q, dC = qC - A.q;
  const double qa = (setup.edge_a[1] * dB + setup.edge_a[2] * dC) * inverse;
  const double qb = (setup.edge_b[1] * dB + setup.edge_b[2] * dC) * inverse;
  setup.q_a = qa;
  setup.q_b = qb;
  setup.q_c = (A.q - qa * Au) - qb * Av;
  const double dq = std::max(std::abs(dB), std::abs(dC));
  const double corner_error = greatest_of(A.q_error, B_given.q_error, C_given.q_error);
  const double q_error =
      corner_error + 4.1 * u * std::abs(A.q) + (72 * delta + 230 * u * L) * L * dq * inverse;
  // 2⁻¹⁹: the room promised, and the roundings of this bound and of its conversion.
  setup.q_error = static_cast<float>(q_error * (1 + 0x1p-19));
  return true;
}

}  // namespace fathom
