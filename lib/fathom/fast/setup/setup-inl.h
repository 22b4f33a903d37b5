// Triangles, several at once, with bounds on their errors. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
//
// The bounds of this file, with u = 2⁻⁵³ (docs/error-analysis.md, "Triangles").
//
// Overflow: usable corners have |u|, |v| ≤ 2³⁰ and |q| ≤ 2⁶⁰, boxes lie within 2³², so L ≤ 2³³, and
// nothing here exceeds 2³⁰⁰.
//
// Underflow: coordinates relative to a sample are 0 or at least 2⁻⁵⁵, because sample coordinates
// are multiples of ½ and at least ½: a corner below ¼ leaves ¼ or more, and one above is a multiple
// of 2⁻⁵⁵, as is the difference. So products of two of them are normal, and so are those with
// differences of q under a perspective camera, where q ≥ 2⁻⁶⁰. Differences of corners as they are
// (area_error) and of q under an orthographic camera may be of any size: products err by at most
// 2⁻¹⁰⁷⁵ more, divisions enlarge that by at most 2¹¹⁰, and the floor of 2⁻¹⁰⁰ in every
// position_error and q_error of such corners covers it.
#if defined(FATHOM_FAST_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_SETUP_INL_H
#undef FATHOM_FAST_SETUP_INL_H
#else
#define FATHOM_FAST_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/fast/setup/setup_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// One corner of several triangles.
struct Corner {
  V u, v, q;
  V position_error, q_error;
};
struct Corners {
  Corner A, B, C;
  /// The greatest of the three corners' errors.
  V position_error, q_error;
};

HWY_INLINE Corner corner_from(V u, V v, V q, V errors) {
  const D d;
  const auto bits = hn::BitCast(DU(), errors);
  return {u, v, q, hn::BitCast(d, hn::And(bits, hn::Set(DU(), 0xFFFFFFFF00000000))),
          hn::BitCast(d, hn::ShiftLeft<32>(bits))};
}

/// Corner `which` of as many triangles as there are lanes.
template <std::size_t which>
HWY_INLINE Corner load_corner(const ImageVertex* vertices, const CornerIndices* triangles) {
  const Records r =
      load_records([&](std::size_t lane) HWY_ATTR { return &vertices[triangles[lane][which]].u; });
  return corner_from(r.first, r.second, r.third, r.fourth);
}

/// Loads as many triangles as there are lanes.
HWY_INLINE Corners load_corners(const ImageVertex* vertices, const CornerIndices* triangles) {
  Corners t{load_corner<0>(vertices, triangles),
            load_corner<1>(vertices, triangles),
            load_corner<2>(vertices, triangles),
            {},
            {}};
  t.position_error = greatest_of(t.A.position_error, t.B.position_error, t.C.position_error);
  t.q_error = greatest_of(t.A.q_error, t.B.q_error, t.C.q_error);
  return t;
}

/// All corners are usable: the greatest error is a number less than 1 (ImageVertex::is_usable()).
HWY_INLINE M are_usable(const Corners& t) {
  return hn::Lt(t.position_error, constant(1));
}
/// All corners are exactly on the grid of snap_step.
HWY_INLINE M are_snapped(const Corners& t) {
  return hn::Eq(t.position_error, constant(0));
}

/// Differences of the corners' computed coordinates: B − A and C − A.
struct Sides {
  V bu, bv, cu, cv;
  [[nodiscard]] HWY_INLINE V doubled_area() const {
    return hn::Sub(hn::Mul(bu, cv), hn::Mul(bv, cu));
  }
};
HWY_INLINE Sides sides_of(const Corners& t) {
  return {hn::Sub(t.B.u, t.A.u), hn::Sub(t.B.v, t.A.v), hn::Sub(t.C.u, t.A.u),
          hn::Sub(t.C.v, t.A.v)};
}

/// A bound on the error of Sides::doubled_area().
//
// Let M be the greatest magnitude of the differences of coordinates; each differs from the exact
// one by at most d = 2e + uM. A difference of two products of such differences then errs by at most
// 4dM + 2d² for its factors and 2uM² + 2uM²(1 + u) ≤ 4.01uM² for its roundings. The bound itself
// is computed with a relative error of up to 8u: area_by_corners covers it up to d = M, and beyond
// it no computed area exceeds the bound.
HWY_INLINE V area_error(const Sides& s, V position_error) {
  const V size = hn::Max(greatest_magnitude(s.bu, s.bv, s.cu), hn::Abs(s.cv));
  const V d =
      hn::MulAdd(constant(unit_roundoff<double>), size, hn::Add(position_error, position_error));
  return hn::MulAdd(hn::MulAdd(constant(setup_bounds::area_by_corners), size, hn::Add(d, d)), d,
                    hn::Mul(constant(setup_bounds::area_rounding), hn::Mul(size, size)));
}

/// The sign of the triangles' doubled area in the image, which is sign(Δ), where it is certain.
/// Where it is, it is the sign of Sides::doubled_area().
struct Orientation {
  M positive, negative, zero;
};

// On the grid of snap_step differences and products are exact (2·16 + 16 bits), and so is the sign.
HWY_INLINE Orientation certified_orientation(const Corners& t) {
  const Sides s = sides_of(t);
  const M snapped = are_snapped(t);
  const V limit = hn::IfThenZeroElse(snapped, area_error(s, t.position_error));
  const V doubled_area = s.doubled_area();
  return {hn::Gt(doubled_area, limit), hn::Lt(doubled_area, hn::Neg(limit)),
          hn::And(snapped, hn::Eq(doubled_area, constant(0)))};
}

/// Integers; empty where a first is greater than a last.
struct Boxes {
  V first_column, last_column, first_row, last_row;
};
HWY_INLINE M are_empty(const Boxes& box) {
  return hn::Or(hn::Gt(box.first_column, box.last_column), hn::Gt(box.first_row, box.last_row));
}

// A covered sample lies in the triangle of the exact corners, so between the least and the greatest
// computed coordinate, moved outwards by the corners' error and by the roundings of the subtraction
// below and of the ½: 2u·(|coordinate| + 1) each, less than 2⁻⁵¹·(|coordinate| + 1) together.
HWY_INLINE V box_margin(V coordinate, V error) {
  return hn::MulAdd(hn::Add(hn::Abs(coordinate), constant(1)), constant(setup_bounds::box_margin),
                    error);
}
/// A bound below all exact coordinates, or above, from a bound on the computed coordinates, which
/// err by `error`.
HWY_INLINE V moved_down(V low, V error) {
  return hn::Sub(low, box_margin(low, error));
}
HWY_INLINE V moved_up(V high, V error) {
  return hn::Add(high, box_margin(high, error));
}
/// The same of columns and rows, which are ½ less than their samples.
HWY_INLINE V least_place(V low, V error) {
  return hn::Sub(moved_down(low, error), constant(0.5));
}
HWY_INLINE V greatest_place(V high, V error) {
  return hn::Sub(moved_up(high, error), constant(0.5));
}

HWY_INLINE V first_sample(V low, V error, double least) {
  return hn::Ceil(hn::Max(least_place(low, error), constant(least)));
}
// The top-left rule moves samples to the right and down, by no step at all: out of a triangle where
// it ends. For corners on the grid that is certain, and half a step less leaves out no other
// sample.
HWY_INLINE V last_sample(V high, V error, M snapped, double greatest) {
  const V place = hn::IfThenElse(snapped, hn::Sub(high, constant(0.5 + snap_step / 2)),
                                 greatest_place(high, error));
  return hn::Floor(hn::Min(place, constant(greatest)));
}

/// The pixels of the area whose samples the triangles can cover.
/// Needs    usable corners.
HWY_INLINE Boxes sample_boxes(const Corners& t, const PixelBox& area) {
  const V e = t.position_error;
  const M snapped = are_snapped(t);
  return {first_sample(least_of(t.A.u, t.B.u, t.C.u), e, area.first_column),
          last_sample(greatest_of(t.A.u, t.B.u, t.C.u), e, snapped, area.last_column),
          first_sample(least_of(t.A.v, t.B.v, t.C.v), e, area.first_row),
          last_sample(greatest_of(t.A.v, t.B.v, t.C.v), e, snapped, area.last_row)};
}

/// The pixels of the area that the triangles meet, by the same argument.
/// Needs    usable corners.
HWY_INLINE Boxes area_boxes(const Corners& t, const PixelBox& area) {
  const V e = t.position_error;
  const auto first = [&](V low, double least) HWY_ATTR {
    return hn::Floor(hn::Max(moved_down(low, e), constant(least)));
  };
  const auto last = [&](V high, double greatest) HWY_ATTR {
    return hn::Floor(hn::Min(moved_up(high, e), constant(greatest)));
  };
  return {first(least_of(t.A.u, t.B.u, t.C.u), area.first_column),
          last(greatest_of(t.A.u, t.B.u, t.C.u), area.last_column),
          first(least_of(t.A.v, t.B.v, t.C.v), area.first_row),
          last(greatest_of(t.A.v, t.B.v, t.C.v), area.last_row)};
}

/// Triangles relative to their boxes' first samples, turned by exchanging B and C so that their
/// doubled area T is positive: certainly where certified_orientation() knows its sign, and where
/// the computed T is greater than its error.
struct LocalTriangles {
  V Au, Av, Bu, Bv, Cu, Cv;
  V qA, qB, qC;
  V T;
  V L, delta;  // see certified_edges
};

HWY_INLINE LocalTriangles localise(const Corners& t, const Boxes& box) {
  const V origin_u = hn::Add(box.first_column, constant(0.5));
  const V origin_v = hn::Add(box.first_row, constant(0.5));
  LocalTriangles l;
  l.Au = hn::Sub(t.A.u, origin_u);
  l.Av = hn::Sub(t.A.v, origin_v);
  const V Bu = hn::Sub(t.B.u, origin_u), Bv = hn::Sub(t.B.v, origin_v);
  const V Cu = hn::Sub(t.C.u, origin_u), Cv = hn::Sub(t.C.v, origin_v);
  const M turn = hn::Lt(sides_of(t).doubled_area(), constant(0));
  l.Bu = hn::IfThenElse(turn, Cu, Bu);
  l.Bv = hn::IfThenElse(turn, Cv, Bv);
  l.Cu = hn::IfThenElse(turn, Bu, Cu);
  l.Cv = hn::IfThenElse(turn, Bv, Cv);
  l.qA = t.A.q;
  l.qB = hn::IfThenElse(turn, t.C.q, t.B.q);
  l.qC = hn::IfThenElse(turn, t.B.q, t.C.q);
  l.T = hn::Sub(hn::Mul(hn::Sub(l.Bu, l.Au), hn::Sub(l.Cv, l.Av)),
                hn::Mul(hn::Sub(l.Bv, l.Av), hn::Sub(l.Cu, l.Au)));
  const V extent = hn::Add(
      hn::Max(hn::Sub(box.last_column, box.first_column), hn::Sub(box.last_row, box.first_row)),
      constant(8));
  l.L = hn::Max(
      extent, hn::Max(greatest_magnitude(l.Au, l.Bu, l.Cu), greatest_magnitude(l.Av, l.Bv, l.Cv)));
  l.delta = hn::MulAdd(constant(unit_roundoff<double>), l.L, t.position_error);
  return l;
}

struct Edges {
  V a[3], b[3], c[3];
  V error;
};

// Local coordinates: the origin is the sample of the box's first pixel, so that samples are exact
// integers. Corners p̂ are the computed ones minus the origin; L ≥ 8 bounds them and the samples.
// Each differs from the exact corner by at most δ = e + uL.
//
// E = (P − s) × (Q − s) = c + a·x + b·y with a = P_v − Q_v, b = Q_u − P_u, c = P_u·Q_v − P_v·Q_u.
// Factors are at most 2L, so moving P and Q by δ changes E by at most η = 8δL + 2δ² ≤ 8.01δL
// (δ ≤ 2⁻¹¹L). Roundings: a, b 2uL each, times L: 4uL²; c 4.01uL²; products 2·2uL²; sums
// 4.01uL² + 6.01uL²: together 22.1uL². Bound: 8.25δL + 24uL².
HWY_INLINE Edges certified_edges(const LocalTriangles& t) {
  Edges e;
  e.a[0] = hn::Sub(t.Bv, t.Cv);
  e.a[1] = hn::Sub(t.Cv, t.Av);
  e.a[2] = hn::Sub(t.Av, t.Bv);
  e.b[0] = hn::Sub(t.Cu, t.Bu);
  e.b[1] = hn::Sub(t.Au, t.Cu);
  e.b[2] = hn::Sub(t.Bu, t.Au);
  e.c[0] = hn::Sub(hn::Mul(t.Bu, t.Cv), hn::Mul(t.Bv, t.Cu));
  e.c[1] = hn::Sub(hn::Mul(t.Cu, t.Av), hn::Mul(t.Cv, t.Au));
  e.c[2] = hn::Sub(hn::Mul(t.Au, t.Bv), hn::Mul(t.Av, t.Bu));
  e.error = hn::Mul(hn::MulAdd(constant(setup_bounds::edge_by_corners), t.delta,
                               hn::Mul(constant(setup_bounds::edge_rounding), t.L)),
                    t.L);
  return e;
}

/// Whether use_top_left_rule() may be called.
HWY_INLINE M have_exact_edges(const Corners& t, const LocalTriangles& l) {
  return hn::And(are_snapped(t), hn::Le(l.L, constant(0x1p16)));
}

// Corners on the grid of step g = 2⁻⁸ with L ≤ 2¹⁶: every term of an edge function is a multiple of
// g² = 2⁻¹⁶ (samples are integers, as the origin is a sample), every sum below 2³⁶, so nothing is
// rounded. A left edge (a > 0) or top edge (a = 0, b > 0) owns its samples: half of g² more makes 0
// positive and leaves other signs alone; elsewhere half of g² less makes 0 negative. With 17 bits
// after the point and 36 before it the moved functions are exact too.
HWY_INLINE void use_top_left_rule(M exact, Edges& e) {
  constexpr double half_step = snap_step * snap_step / 2;
  for (int i = 0; i < 3; ++i) {
    const M top = hn::And(hn::Eq(e.a[i], constant(0)), hn::Gt(e.b[i], constant(0)));
    const M has_samples = hn::Or(hn::Gt(e.a[i], constant(0)), top);
    const V move = hn::IfThenElse(has_samples, constant(half_step), constant(-half_step));
    e.c[i] = hn::IfThenElse(exact, hn::Add(e.c[i], move), e.c[i]);
  }
  e.error = hn::IfThenElse(exact, constant(half_step / 2), e.error);
}

struct Depths {
  V a, b, c;
  V error;
};

// q(s) = q_A + β(q_B − q_A) + γ(q_C − q_A) with β = E_B/T, γ = E_C/T, T the doubled area. F is the
// same function for the corners p̂, q̂ (certified_edges), in real arithmetic, T' its area. At a
// covered sample 0 ≤ β, γ, β + γ ≤ 1, so
//   |q − F| ≤ e_q + (|β − β'| + |γ − γ'|)·dq,  dq = max(|q̂_B − q̂_A|, |q̂_C − q̂_A|),
//   |β − β'| = |(E_B − E_B')/T' + β(T' − T)/T'| ≤ (η + 3ηβ)/T' (T is the sum of three edge
// functions), together e_q + 5η·dq/T' ≤ e_q + 40.1δL·dq/T'.
// Rounding, in units of uL²·dq/T̂: T̂ errs by 32.1uL², which scales F − q̂_A by 32.1(1 + 5η/T').
// For the real gradients over T̂: their computed numerators err by 16 each over |s − A| ≤ 2L,
// together 64; 1/T̂ and the product by 2u·|gradient|·2L: 32; c: 20 and 2u|q_A|; the evaluation: 36
// and 2u|q_A|: 152.1, and 4.1u|q_A|.
// The condition T̂ ≥ 16·(8.25δL + 24uL²) gives T' ≥ 0.93·T̂, so 1.07·40.1 and 152.1 + 34.3·1.05 are
// enough; 72 and 230 are used.
HWY_INLINE Depths certified_depths(const Corners& t, const LocalTriangles& l, const Edges& e) {
  const V inverse = hn::Div(constant(1), l.T);
  const V dB = hn::Sub(l.qB, l.qA), dC = hn::Sub(l.qC, l.qA);
  Depths q;
  q.a = hn::Mul(hn::MulAdd(e.a[1], dB, hn::Mul(e.a[2], dC)), inverse);
  q.b = hn::Mul(hn::MulAdd(e.b[1], dB, hn::Mul(e.b[2], dC)), inverse);
  q.c = hn::NegMulAdd(q.b, l.Av, hn::NegMulAdd(q.a, l.Au, l.qA));
  const V dq = hn::Max(hn::Abs(dB), hn::Abs(dC));
  const V corners = hn::MulAdd(constant(setup_bounds::q_of_corner), hn::Abs(l.qA), t.q_error);
  const V slope = hn::Mul(hn::MulAdd(constant(setup_bounds::q_by_corners), l.delta,
                                     hn::Mul(constant(setup_bounds::q_rounding), l.L)),
                          l.L);
  // 2⁻¹⁹: the promised room, and the roundings of this bound.
  q.error =
      hn::Mul(hn::MulAdd(hn::Mul(slope, dq), inverse, corners), constant(setup_bounds::q_room));
  return q;
}

/// Whether depths at samples of the triangles may leave the range that counts: q of a covered
/// sample lies between the q of the corners.
HWY_INLINE M may_leave(const DepthRange& range, const Corners& t) {
  const V error = hn::Add(t.q_error, t.q_error);
  const V least = hn::Sub(least_of(t.A.q, t.B.q, t.C.q), error);
  const V greatest = hn::Add(greatest_of(t.A.q, t.B.q, t.C.q), error);
  return hn::Not(hn::And(hn::Ge(least, constant(range.inside_least)),
                         hn::Le(greatest, constant(range.inside_greatest))));
}

HWY_INLINE void store(V v, SetupBatch::Numbers& numbers) {
  hn::Store(v, D(), numbers.data());
}

HWY_INLINE void store(const Edges& e, const Depths& q, const Boxes& box, SetupBatch& batch) {
  for (std::size_t i = 0; i < 3; ++i) {
    store(e.a[i], batch.edge_a[i]);
    store(e.b[i], batch.edge_b[i]);
    store(e.c[i], batch.edge_c[i]);
  }
  store(e.error, batch.edge_error);
  store(q.a, batch.q_a);
  store(q.b, batch.q_b);
  store(q.c, batch.q_c);
  store(q.error, batch.q_error);
  store(box.first_column, batch.first_column);
  store(box.last_column, batch.last_column);
  store(box.first_row, batch.first_row);
  store(box.last_row, batch.last_row);
}

/// As many triangles as there are lanes; see certified_setups() in setup.h.
HWY_INLINE void set_up_lanes(const ImageVertex* vertices, const CornerIndices* triangles,
                             const PixelBox& area, const DepthRange& range, SetupBatch& batch) {
  const Corners t = load_corners(vertices, triangles);
  const M usable = are_usable(t);
  const Boxes box = sample_boxes(t, area);
  const LocalTriangles l = localise(t, box);
  Edges e = certified_edges(l);
  const M safe =
      hn::And(usable, hn::Ge(l.T, hn::Mul(constant(setup_bounds::triangle_thinness), e.error)));
  const M snapped = have_exact_edges(t, l);
  use_top_left_rule(snapped, e);
  const Depths q = certified_depths(t, l, e);
  store(e, q, box, batch);
  batch.empty = bits_of(hn::And(usable, are_empty(box)));
  batch.refused = bits_of(hn::Not(safe));
  batch.snapped = bits_of(snapped);
  batch.test_range = bits_of(hn::Or(hn::Not(usable), may_leave(range, t)));
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
