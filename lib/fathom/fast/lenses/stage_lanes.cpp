// Places of samples under a stage, several at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/lenses/stage_lanes.cpp"
#include "fathom/fast/lenses/stage_lanes.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "fathom/fast/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

struct Point {
  V x, y;
};

/// p(q) and p'(q).
struct Polynomial {
  V value, slope;
};
HWY_INLINE Polynomial polynomial_at(const std::array<double, StageForLanes::most>& p,
                                    std::size_t count, V q) {
  V value = constant(p[count - 1]), slope = constant(0);
  for (std::size_t i = count - 1; i-- > 0;) {
    slope = hn::MulAdd(slope, q, value);
    value = hn::MulAdd(value, q, constant(p[i]));
  }
  return {value, slope};
}

/// S(m) and its Jacobian, as in lens/stage.h.
struct StageValue {
  Point S;
  V xx, xy, yx, yy;
};
HWY_INLINE StageValue single_stage_at(const StageForLanes& n, Point m) {
  const V q = hn::MulAdd(m.x, m.x, hn::Mul(m.y, m.y));
  const Polynomial N = polynomial_at(n.numerator, n.numerator_count, q);
  V L = N.value, slope = N.slope;
  if (n.denominator_count > 1) {
    const Polynomial divisor = polynomial_at(n.denominator, n.denominator_count, q);
    L = hn::Div(N.value, divisor.value);
    slope = hn::Div(hn::NegMulAdd(L, divisor.slope, N.slope), divisor.value);
  }
  const V p1 = constant(n.p1), p2 = constant(n.p2);
  const V two_x = hn::Add(m.x, m.x), two_y = hn::Add(m.y, m.y), xy = hn::Mul(m.x, m.y);
  const V sx = hn::MulAdd(constant(n.s2), q, constant(n.s1));
  const V sy = hn::MulAdd(constant(n.s4), q, constant(n.s3));
  StageValue s;
  s.S.x = hn::MulAdd(m.x, L, hn::Mul(hn::Add(p1, p1), xy));
  s.S.x = hn::MulAdd(p2, hn::MulAdd(two_x, m.x, q), s.S.x);
  s.S.x = hn::MulAdd(sx, q, s.S.x);
  s.S.y = hn::MulAdd(m.y, L, hn::Mul(hn::Add(p2, p2), xy));
  s.S.y = hn::MulAdd(p1, hn::MulAdd(two_y, m.y, q), s.S.y);
  s.S.y = hn::MulAdd(sy, q, s.S.y);
  const V A = hn::MulAdd(hn::Add(p2, p2), m.x, hn::MulAdd(hn::Add(p1, p1), m.y, L));
  const V gx = hn::MulAdd(slope, m.x, p2), gy = hn::MulAdd(slope, m.y, p1);
  const V bx = hn::Add(p2, hn::MulAdd(constant(n.s2), q, sx));
  const V by = hn::Add(p1, hn::MulAdd(constant(n.s4), q, sy));
  s.xx = hn::MulAdd(two_x, hn::Add(gx, bx), A);
  s.xy = hn::MulAdd(two_x, gy, hn::Mul(two_y, bx));
  s.yx = hn::MulAdd(two_y, gx, hn::Mul(two_x, by));
  s.yy = hn::MulAdd(two_y, hn::Add(gy, by), A);
  return s;
}

/// The same of two stages, the first of which is radial.
HWY_INLINE StageValue stage_at(const StageForLanes& n, Point m) {
  if (n.before_count == 0) return single_stage_at(n, m);
  const V q = hn::MulAdd(m.x, m.x, hn::Mul(m.y, m.y));
  const auto [factor, slope] = polynomial_at(n.before, n.before_count, q);
  const V of_x = hn::Mul(hn::Add(slope, slope), m.x), of_y = hn::Mul(hn::Add(slope, slope), m.y);
  const V xx = hn::MulAdd(of_x, m.x, factor), yy = hn::MulAdd(of_y, m.y, factor);
  const V across = hn::Mul(of_x, m.y);
  const StageValue s = single_stage_at(n, {hn::Mul(m.x, factor), hn::Mul(m.y, factor)});
  return {s.S, hn::MulAdd(s.xx, xx, hn::Mul(s.xy, across)),
          hn::MulAdd(s.xx, across, hn::Mul(s.xy, yy)), hn::MulAdd(s.yx, xx, hn::Mul(s.yy, across)),
          hn::MulAdd(s.yx, across, hn::Mul(s.yy, yy))};
}

/// The inverse of a Jacobian.
struct Inverse {
  V xx, xy, yx, yy;
};
HWY_INLINE Inverse inverse_of(const StageValue& s) {
  const V factor = hn::Div(constant(1), hn::MulSub(s.xx, s.yy, hn::Mul(s.xy, s.yx)));
  return {hn::Mul(s.yy, factor), hn::Neg(hn::Mul(s.xy, factor)), hn::Neg(hn::Mul(s.yx, factor)),
          hn::Mul(s.xx, factor)};
}

/// A step of Newton's method for S(m) = y.
HWY_INLINE Point step(const Inverse& J, Point S, Point m, Point y) {
  const V rx = hn::Sub(S.x, y.x), ry = hn::Sub(S.y, y.y);
  return {hn::NegMulAdd(J.xx, rx, hn::NegMulAdd(J.xy, ry, m.x)),
          hn::NegMulAdd(J.yx, rx, hn::NegMulAdd(J.yy, ry, m.y))};
}

HWY_INLINE Point plane_at(const PlaneForLanes& plane, V u, V v) {
  const V U = hn::Sub(u, constant(plane.centre_u)), W = hn::Sub(v, constant(plane.centre_v));
  const auto at = [&](const std::array<double, 3>& g) HWY_ATTR {
    return hn::MulAdd(constant(g[0]), U, hn::MulAdd(constant(g[1]), W, constant(g[2])));
  };
  const Point n{at(plane.g[0]), at(plane.g[1])};
  if (plane.is_affine) return n;
  const V z = at(plane.g[2]);
  return {hn::Div(n.x, z), hn::Div(n.y, z)};
}

/// After the first, from the middle of the block. Each leaves about the square of the error of the
/// one before; near the edge of the disc it takes more of them.
constexpr int most_steps = 8;

HWY_INLINE V residual_of(Point S, Point y) {
  const V x = hn::Sub(S.x, y.x), z = hn::Sub(S.y, y.y);
  return hn::Sqrt(hn::MulAdd(x, x, hn::Mul(z, z)));
}

/// Whether there is nothing left but roundings.
HWY_INLINE bool is_small(V residual, Point m, Point y) {
  const V size = hn::Add(hn::Add(hn::Abs(m.x), hn::Abs(m.y)), hn::Add(hn::Abs(y.x), hn::Abs(y.y)));
  return hn::AllTrue(D(), hn::Le(residual, hn::Mul(size, constant(0x1p-52))));
}

void search(const StageForLanes& stage, const PlaneForLanes& plane, double first_column,
            double first_row, double x, double y, BlockSamples& samples) {
  const D d;
  alignas(64) double u[BlockSamples::count], v[BlockSamples::count];
  constexpr std::size_t cell = TileShape::cell, cells = TileShape::block / cell;
  for (std::size_t i = 0; i < BlockSamples::count; ++i) {
    const std::size_t number = i / (cell * cell), column = i % cell, row = i / cell % cell;
    u[i] = first_column + 0.5 + static_cast<double>(number % cells * cell + column);
    v[i] = first_row + 0.5 + static_cast<double>(number / cells * cell + row);
  }
  const Point start{constant(x), constant(y)};
  const StageValue at_start = stage_at(stage, start);
  const Inverse from_start = inverse_of(at_start);
  const V no_end = constant(std::numeric_limits<double>::infinity());
  V left = no_end, right = hn::Neg(no_end), top = left, bottom = right, greatest = constant(0);
  for (std::size_t i = 0; i < BlockSamples::count; i += hn::Lanes(d)) {
    const Point target = plane_at(plane, hn::Load(d, u + i), hn::Load(d, v + i));
    Point m = step(from_start, at_start.S, start, target);
    StageValue at_m = stage_at(stage, m);
    V residual = residual_of(at_m.S, target);
    for (int k = 0; k < most_steps && !is_small(residual, m, target); ++k) {
      m = step(inverse_of(at_m), at_m.S, m, target);
      at_m = stage_at(stage, m);
      residual = residual_of(at_m.S, target);
    }
    hn::Store(m.x, d, samples.x.data() + i);
    hn::Store(m.y, d, samples.y.data() + i);
    hn::Store(residual, d, samples.residual.data() + i);
    left = hn::Min(left, m.x);
    right = hn::Max(right, m.x);
    top = hn::Min(top, m.y);
    bottom = hn::Max(bottom, m.y);
    greatest = hn::Max(greatest, hn::IfThenElse(hn::Lt(residual, no_end), residual, no_end));
  }
  samples.left = hn::GetLane(hn::MinOfLanes(d, left));
  samples.right = hn::GetLane(hn::MaxOfLanes(d, right));
  samples.top = hn::GetLane(hn::MinOfLanes(d, top));
  samples.bottom = hn::GetLane(hn::MaxOfLanes(d, bottom));
  samples.greatest_residual = hn::GetLane(hn::MaxOfLanes(d, greatest));
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(search);

StageForLanes::StageForLanes(const lens::StageNumbers<double>& stage)
    : numerator_count(stage.numerator.size()),
      denominator_count(stage.denominator.size()),
      before_count(stage.before.size()),
      p1(stage.p1),
      p2(stage.p2),
      s1(stage.s1),
      s2(stage.s2),
      s3(stage.s3),
      s4(stage.s4) {
  std::ranges::copy(stage.numerator, numerator.begin());
  std::ranges::copy(stage.denominator, denominator.begin());
  std::ranges::copy(stage.before, before.begin());
}

void search_block(const StageForLanes& stage, const PlaneForLanes& plane, double first_column,
                  double first_row, double x, double y, BlockSamples& samples) {
  HWY_DYNAMIC_DISPATCH(search)(stage, plane, first_column, first_row, x, y, samples);
}

}  // namespace fathom::fast
#endif
