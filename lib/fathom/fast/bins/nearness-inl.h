// nearness.h for several triangles at once. Included once for every kind of vector instructions, by
// the files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_NEARNESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_NEARNESS_INL_H
#undef FATHOM_FAST_NEARNESS_INL_H
#else
#define FATHOM_FAST_NEARNESS_INL_H
#endif

#include <hwy/highway.h>

#include "fathom/fast/bins/nearness.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/setup/setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// Numbers rounded to binary32 and moved_up_in_24_bits(), in the lower halves.
HWY_INLINE hn::Vec<DU> moved_up_in_24_bits(V q) {
  const DU du;
  const hn::Rebind<std::uint32_t, D> du32;
  const auto bits = hn::PromoteTo(du, hn::BitCast(du32, to_binary32(q)));
  const auto whole = hn::Set(du, std::uint64_t{nearness_of_q});
  const auto negative = hn::Ne(hn::And(bits, hn::Set(du, 0x80000000)), hn::Zero(du));
  return hn::IfThenElse(negative, hn::Sub(hn::And(bits, whole), hn::Set(du, 0x100)),
                        hn::And(hn::Add(bits, hn::Set(du, 0x1FF)), whole));
}

/// nearness_in() of boxes of pixels that lie in the tile of this column and row, in the lower
/// halves.
HWY_INLINE hn::Vec<DU> nearness_in(hn::Vec<DU> q, const Boxes& box, V tile_column, V tile_row) {
  const DU du;
  const auto block_of = [](V pixel) HWY_ATTR {
    return hn::Floor(hn::Mul(pixel, constant(1.0 / TileShape::block)));
  };
  const V blocks = constant(TileShape::blocks_of_row);
  const V left = block_of(box.first_column), top = block_of(box.first_row);
  const V more =
      hn::Max(hn::Sub(block_of(box.last_column), left), hn::Sub(block_of(box.last_row), top));
  const V column = hn::NegMulAdd(tile_column, blocks, left);
  const V row = hn::NegMulAdd(tile_row, blocks, top);
  const V place =
      hn::Add(hn::MulAdd(row, blocks, column),
              hn::IfThenElseZero(hn::Gt(more, constant(1)), constant(nearness_of_more)));
  const auto known = hn::Or(q, hn::BitCast(du, hn::ConvertTo(DI(), place)));
  return hn::IfThenElse(hn::RebindMask(du, hn::Gt(more, constant(3))),
                        hn::Set(du, std::uint64_t{never_hidden}), known);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
