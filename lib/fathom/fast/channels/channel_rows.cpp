#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/channels/channel_rows.cpp"
#include "fathom/fast/channels/channel_rows.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <limits>

#include "fathom/fast/channels/round_lanes-inl.h"
#include "fathom/fast/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
using namespace triangle;

namespace {

constexpr double ulp = epsilon<double>;

/// D from q. Perspective: 1/q, where |1/q̂ − 1/q| = |q − q̂|/(q·q̂) and q ≥ q̂·(1 − 2⁻²⁰), and the
/// division rounds (validation/proofs/depth/depth_row.gappa.in). Orthographic: −q. A bound of NaN
/// means "unknown". Nothing underflows: bounds on q are at least 2⁻¹⁰⁰ or u·|q|, so known depths
/// lie between 2⁻¹⁰⁰ and 2⁸⁰, or err by at least 2⁻¹⁰⁰.
HWY_INLINE CertifiedLanes load_depth(const SurfaceRow& row, std::size_t first, bool perspective) {
  const D d;
  const V q = hn::LoadU(d, row.q + first);
  const V q_error = hn::BitCast(d, hn::LoadU(DU(), row.tags + first));
  if (!perspective) return {hn::Neg(q), q_error};
  const V depth = hn::Div(constant(1), q);
  const V relative = hn::MulAdd(q_error, depth, constant(ulp));
  const V error = hn::Mul(hn::Mul(relative, depth), constant(slack));
  const M known = hn::Le(q_error, hn::Mul(q, constant(quotient_condition)));
  return {depth, hn::IfThenElse(known, error, constant(std::numeric_limits<double>::infinity()))};
}

/// Like to_code() of a binary64 number with an error, to which scaling adds a rounding, and the
/// error of a rounded factor (validation/proofs/depth/scaled_code.gappa.in, divided_code.gappa.in).
HWY_INLINE void round_lanes(const CertifiedLanes& x, const CodeFactor& factor, std::size_t first,
                            RoundedValues<std::uint16_t>& rounded) {
  const D d;
  const V scale = constant(factor.value);
  const V scaled = hn::Mul(x.value, scale);
  const V error = hn::Mul(hn::MulAdd(x.error, scale, hn::Mul(scaled, constant(ulp + factor.error))),
                          constant(slack));
  const V code = hn::Round(scaled);
  const V rest = hn::Abs(hn::Sub(scaled, code));
  const M near = hn::Lt(hn::MulAdd(rest, constant(distance_room), error), constant(0.5));
  const M in_range = hn::And(hn::Ge(code, constant(1)), hn::Le(code, constant(65535)));
  const M settled = hn::And(near, in_range);
  HWY_ALIGN double codes[8];
  hn::StoreU(hn::IfThenElseZero(settled, code), d, codes);
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
    rounded.values[first + k] = static_cast<std::uint16_t>(codes[k]);
  }
  rounded.settled |= std::uint64_t{bits_of(settled)} << first;
}

/// A coordinate of origin or direction along a row: a + b·u.
struct AlongRow {
  double a, b;
  AlongRow(double entry, double along_v, double along_u, double v)
      : a(entry + along_v * v), b(along_u) {}
  [[nodiscard]] HWY_INLINE V at(V u) const { return hn::MulAdd(constant(b), u, constant(a)); }
};

/// Like position() in triangle/double_word_surface.h.
HWY_ATTR void round_lanes_of_positions(const SurfaceRow& row, const Rays& world,
                                       const RaySizes& sizes, bool perspective,
                                       std::array<RoundedValues<float>, 3>& rounded) {
  const auto& [m0, m1, m2, O] = world.columns;
  const auto& varying = perspective ? m2 : O;
  const auto& fixed = perspective ? O : m2;
  const std::array<AlongRow, 3> along{AlongRow(varying[0].hi, m1[0].hi, m0[0].hi, row.v),
                                      AlongRow(varying[1].hi, m1[1].hi, m0[1].hi, row.v),
                                      AlongRow(varying[2].hi, m1[2].hi, m0[2].hi, row.v)};
  for (RoundedValues<float>& r : rounded) r.settled = 0;
  for (std::size_t first = 0; first < TileShape::size; first += hn::Lanes(D())) {
    const CertifiedLanes depth = load_depth(row, first, perspective);
    const V u = load_u(row, first), depth_size = hn::Abs(depth.value);
    for (std::size_t i = 0; i < 3; ++i) {
      const V constant_part = constant(fixed[i].hi), varying_part = along[i].at(u);
      const V origin = perspective ? constant_part : varying_part;
      const V d = perspective ? varying_part : constant_part;
      const V d_size = constant(sizes.direction[i]);
      const V size = hn::MulAdd(d_size, depth_size, constant(sizes.origin[i]));
      const V error =
          hn::MulAdd(size, constant(surface_bounds::position * ulp), hn::Mul(d_size, depth.error));
      store_rounded({hn::MulAdd(d, depth.value, origin), hn::Mul(error, constant(slack))}, first,
                    rounded[i]);
    }
  }
}

/// Like ray_length() and product() in triangle/double_word_surface.h.
HWY_INLINE CertifiedLanes times_ray_length(const CertifiedLanes& depth, V u, const SurfaceRow& row,
                                           const SceneRays& rays) {
  const auto& [kx, ky] = rays.lens();
  const V x = AlongRow(kx[2].hi, kx[1].hi, kx[0].hi, row.v).at(u);
  const V y = AlongRow(ky[2].hi, ky[1].hi, ky[0].hi, row.v).at(u);
  const V length = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, constant(1))));
  const V length_error =
      hn::Mul(hn::Add(length, constant(surface_bounds::ray_length * rays.lens_size() + 1)),
              constant(ulp * slack));
  const V value = hn::Mul(depth.value, length);
  const V size = hn::Abs(depth.value);
  const V error = hn::MulAdd(size, length_error,
                             hn::MulAdd(hn::Add(length, length_error), depth.error,
                                        hn::Mul(hn::Abs(value), constant(ulp))));
  return {value, hn::Mul(error, constant(slack))};
}

template <class Round>
HWY_INLINE void for_lanes(const SurfaceRow& row, const SceneRays& rays, bool distance,
                          const Round& round) {
  const bool times_length = distance && rays.perspective();
  for (std::size_t first = 0; first < TileShape::size; first += hn::Lanes(D())) {
    const CertifiedLanes depth = load_depth(row, first, rays.perspective());
    round(times_length ? times_ray_length(depth, load_u(row, first), row, rays) : depth, first);
  }
}

HWY_ATTR void round_lanes_of_depths(const SurfaceRow& row, const SceneRays& rays, bool distance,
                                    RoundedValues<float>& rounded) {
  rounded.settled = 0;
  for_lanes(row, rays, distance, [&](const CertifiedLanes& x, std::size_t first) HWY_ATTR {
    store_rounded(x, first, rounded);
  });
}

HWY_ATTR void round_lanes_to_codes(const SurfaceRow& row, const SceneRays& rays, bool distance,
                                   const CodeFactor& factor,
                                   RoundedValues<std::uint16_t>& rounded) {
  rounded.settled = 0;
  for_lanes(row, rays, distance, [&](const CertifiedLanes& x, std::size_t first) HWY_ATTR {
    round_lanes(x, factor, first, rounded);
  });
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(round_lanes_of_positions);
HWY_EXPORT(round_lanes_of_depths);
HWY_EXPORT(round_lanes_to_codes);

void round_positions(const SurfaceRow& row, const Rays& world, const RaySizes& sizes,
                     bool perspective, std::array<RoundedValues<float>, 3>& rounded) {
  HWY_DYNAMIC_DISPATCH(round_lanes_of_positions)(row, world, sizes, perspective, rounded);
}

void round_depths(const SurfaceRow& row, const SceneRays& rays, bool distance,
                  RoundedValues<float>& rounded) {
  HWY_DYNAMIC_DISPATCH(round_lanes_of_depths)(row, rays, distance, rounded);
}

void round_to_codes(const SurfaceRow& row, const SceneRays& rays, bool distance,
                    const CodeFactor& factor, RoundedValues<std::uint16_t>& rounded) {
  HWY_DYNAMIC_DISPATCH(round_lanes_to_codes)(row, rays, distance, factor, rounded);
}

}  // namespace fathom::fast
#endif
