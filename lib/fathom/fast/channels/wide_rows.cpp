#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/channels/wide_rows.cpp"
#include "fathom/fast/channels/wide_rows.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "fathom/fast/channels/round_lanes-inl.h"
#include "fathom/fast/lanes/double_word_lanes-inl.h"
#include "fathom/fast/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
using namespace triangle;

namespace {

/// Forms at the samples of a row: begin + a·u.
struct WideForms {
  WideLanes begin, a, constant;
  V error, constant_error;
};

HWY_INLINE WideForms wide_forms_of(const WideDepth& f, V v) {
  return {add(wide_constant(f.c), multiply(wide_constant(f.b), v)), wide_constant(f.a),
          wide_constant(f.constant), constant(f.error), constant(f.constant_error)};
}

HWY_INLINE WideForms wide_forms_of(const WideDepth* depths, const std::uint32_t* indices, V v) {
  const auto at = [&](std::size_t lane) HWY_ATTR { return &depths[indices[lane]].c.hi; };
  const Records first = load_records(at);
  const Records second = load_records([&](std::size_t lane) HWY_ATTR { return at(lane) + 4; });
  const Records third = load_records([&](std::size_t lane) HWY_ATTR { return at(lane) + 8; });
  return {add({first.first, first.second}, multiply(WideLanes{first.third, first.fourth}, v)),
          {second.first, second.second},
          {second.third, second.fourth},
          third.first,
          third.second};
}

/// The forms of the surfaces of a row, one vector after another.
class FormsOfRow {
 public:
  HWY_INLINE FormsOfRow(const WideDepth* depths, const SurfaceIndices& indices, double v)
      : depths_(depths),
        indices_(indices),
        v_(constant(v)),
        last_(indices[0]),
        forms_(wide_forms_of(depths[indices[0]], v_)) {}

  HWY_INLINE WideForms at(std::size_t first) {
    const LaneIndices at = indices_at(indices_.data(), first);
    if (!at.are_same) return wide_forms_of(depths_, at.first, v_);
    if (*at.first != last_) forms_ = wide_forms_of(depths_[last_ = *at.first], v_);
    return forms_;
  }

 private:
  const WideDepth* depths_;
  const SurfaceIndices& indices_;
  V v_;
  std::uint32_t last_;
  WideForms forms_;
};

HWY_INLINE CertifiedWideLanes depth_of(const WideForms& f, V u, bool perspective) {
  const CertifiedWideLanes varying{add(f.begin, multiply(f.a, u)), f.error};
  const CertifiedWideLanes fixed{f.constant, f.constant_error};
  return perspective ? quotient(fixed, varying) : quotient(varying, fixed);
}

/// Like ray_length() in triangle/double_word_surface.h; terms that are 0 are left out, and in the
/// sum of the squares the square of y and 1 are added first: their sum is the same for a row of
/// pixels if y is.
class RayLengths {
 public:
  HWY_INLINE RayLengths(const SceneRays& rays, double v)
      : x_(rays.lens()[0], v),
        y_(rays.lens()[1], v),
        rest_(add(multiply(y_.begin, y_.begin), one())),
        fixed_error_(surface_bounds::ray_length * rays.lens_size() + 1) {}

  HWY_INLINE CertifiedWideLanes at(V u) const {
    const WideLanes x = x_.at(u);
    WideLanes rest = rest_;
    if (y_.varies) {
      const WideLanes y = y_.at(u);
      rest = add(multiply(y, y), one());
    }
    const WideLanes length = square_root(add(multiply(x, x), rest));
    const V error =
        hn::Mul(constant(wide_ulp * slack), hn::Add(constant(fixed_error_), hn::Abs(length.hi)));
    return {length, error};
  }

 private:
  struct Coordinate {
    WideLanes begin, along_u;
    bool varies;

    HWY_INLINE Coordinate(const std::array<WordPair, 3>& k, double v)
        : begin(add(wide_constant(k[2]), multiply(wide_constant(k[1]), constant(v)))),
          along_u(wide_constant(k[0])),
          varies(k[0].hi != 0) {}
    HWY_INLINE WideLanes at(V u) const { return add(begin, multiply(along_u, u)); }
  };
  static HWY_INLINE WideLanes one() { return {constant(1), constant(0)}; }

  Coordinate x_, y_;
  WideLanes rest_;
  double fixed_error_;
};

HWY_INLINE void store_wide(const CertifiedWideLanes& x, std::size_t first,
                           RoundedValues<double>& rounded) {
  const D d;
  hn::StoreU(hn::Add(x.value.hi, constant(0)), d, rounded.values.data() + first);
  rounded.settled |= std::uint64_t{bits_of(rounds_to_leading_word(x.value, x.error))} << first;
}

/// D − Z: hi − Z is exact, as Z is the binary32 number nearest to hi.
HWY_INLINE void store_low_part(const CertifiedWideLanes& depth, std::size_t first,
                               RoundedValues<float>& rounded) {
  const D d;
  const RoundedWideLanes Z = round_to_binary32(depth.value, depth.error);
  const WideLanes rest =
      two_sum(hn::Sub(depth.value.hi, hn::PromoteTo(d, Z.value)), depth.value.lo);
  const RoundedWideLanes low = round_to_binary32(rest, depth.error);
  hn::StoreU(low.value, D32(), rounded.values.data() + first);
  rounded.settled |= std::uint64_t{bits_of(hn::And(Z.settled, low.settled))} << first;
}

void wide_lanes(const SurfaceRow& row, const SurfaceIndices& indices, const WideDepth* depths,
                const SceneRays& rays, const WideRows& wanted) {
  const bool perspective = rays.perspective();
  FormsOfRow forms(depths, indices, row.v);
  const RayLengths lengths(rays, row.v);
  if (wanted.depth) wanted.depth->settled = 0;
  if (wanted.distance) wanted.distance->settled = 0;
  if (wanted.low) wanted.low->settled = 0;
  for (std::size_t first = 0; first < TileShape::size; first += hn::Lanes(D())) {
    const V u = load_u(row, first);
    const CertifiedWideLanes depth = depth_of(forms.at(first), u, perspective);
    if (wanted.depth) store_wide(depth, first, *wanted.depth);
    if (wanted.low) store_low_part(depth, first, *wanted.low);
    if (wanted.distance) {
      store_wide(perspective ? product(depth, lengths.at(u)) : depth, first, *wanted.distance);
    }
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(wide_lanes);

void round_wide(const SurfaceRow& row, const SurfaceIndices& indices, const WideDepth* depths,
                const triangle::SceneRays& rays, const WideRows& wanted) {
  HWY_DYNAMIC_DISPATCH(wide_lanes)(row, indices, depths, rays, wanted);
}

WideDepth unknown_wide_depth() {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  return {{}, {}, {}, {}, unknown, unknown};
}

WideDepth wide_depth(SurfaceFacts& surface, const ValueFrame& frame) {
  if (!surface.usable) return unknown_wide_depth();
  const auto& [varying, constant] = depth_of(surface, frame);
  const auto& [a, b, c, error] = varying;
  // Only where the form may be a constant is it worth while to find out.
  if (std::abs(a.hi) * frame.image.u + std::abs(b.hi) * frame.image.v <= error) {
    if (const auto& depth = constant_of(surface, 3)) {
      const WordPair one{1, 0};
      if (frame.image.perspective) return {one, {}, {}, *depth, 0, 0};
      return {*depth, {}, {}, one, 0, 0};
    }
  }
  return {c, b, a, constant.value, error, constant.error};
}

}  // namespace fathom::fast
#endif
