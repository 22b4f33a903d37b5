#pragma once

#include <array>

#include "fathom/lens/polynomial_stage.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/lens/stage.h"
#include "fathom/numeric/interval.h"

/// The preimages of a point under a stage as roots of one polynomial, over any arithmetic.
///
/// With p = (p2, p1) and b(q) = p + (s1 + s2·q, s3 + s4·q) the stage is G(m) = m·(L + 2p·m) + q·b.
/// If G(m) = y and q = |m|², then w = y − q·b(q) is known, and m is w/A with A = L + 2p·m. With
/// W = |w|², elimination of A gives
///   F(q) = q·N²·W − D²·(W − 2q·p·w)² = 0,   m = q·N·w / (D·(W − 2q·p·w)).
/// For y ≠ 0, F is negative at 0. In the disc (polynomial_stage.h) it changes its sign once at
/// most, at the preimage: A is positive there, which makes other zeroes (where w = 0) minima with
/// the value 0, beyond the preimage.
///
/// Of two stages, the second takes t = m·N₁(q) to y. The same F, of |t|² = q·N₁(q)², which grows
/// with q in the disc, shows q; and m is t/N₁(q).
namespace fathom::lens {

template <class T>
struct Elimination {
  /// c⁴·F(q).
  T f;
  /// At the root: a positive multiple of (m, 1). Its third component is c²·D·(W − 2q·p·w).
  std::array<T, 3> direction;
};

template <class T>
Elimination<T> eliminate_single(const StageNumbers<T>& n, const HomogeneousPoint<T>& y,
                                const T& q) {
  const T N = horner(n.numerator, q), D = horner(n.denominator, q), qc = q * y.c;
  // c·w, c²·W and c²·(W − 2q·p·w)
  const T wx = y.a - qc * (n.p2 + n.s1 + n.s2 * q);
  const T wy = y.b - qc * (n.p1 + n.s3 + n.s4 * q);
  const T W = wx * wx + wy * wy;
  const T rest = W - (qc + qc) * (n.p2 * wx + n.p1 * wy);
  const T D_rest = D * rest, N_qc = N * qc;
  return {N_qc * N * y.c * W - D_rest * D_rest, {N_qc * wx, N_qc * wy, D_rest}};
}

template <class T>
Elimination<T> eliminate(const StageNumbers<T>& n, const HomogeneousPoint<T>& y, const T& q) {
  if (!n.is_double()) return eliminate_single(n, y, q);
  Elimination<T> result = eliminate_single(n, y, image_of_circle(n, q));
  result.direction[2] = result.direction[2] * horner(n.before, q);
  return result;
}

enum class Existence { yes, no, unknown };

/// The root of F (Elimination) in the disc, as far as binary64 can decide.
struct RootEstimate {
  Existence existence = Existence::unknown;
  /// F is negative at `low` and positive at `high`, both in the disc.
  double low = 0, high = 0;
  /// Contains (m, 1).
  std::array<Interval, 3> box{};
};

/// Of y ≠ 0. All that is stated is proved by bounds on rounding errors; near the edge of the disc,
/// or with very large or small numbers, nothing is.
RootEstimate estimate_root(const PolynomialStage& stage, const DistortedPoint& y);

}  // namespace fathom::lens
