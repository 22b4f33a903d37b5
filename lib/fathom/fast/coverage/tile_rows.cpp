#include "fathom/fast/coverage/tile_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/coverage/tile_rows.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// Bits of a cell's samples, row by row.
struct CellBits {
  std::uint32_t shown = 0, front = 0;
};

// Places are less than 2¹⁶: signed numbers that are compared.
HWY_INLINE CellBits look_at_cell(const LaneTag* tags, LaneTag end_of_front) {
  const DT dt;
  const hn::RebindToSigned<DT> di;
  const auto place = hn::Set(dt, Tile::place_of(~LaneTag{0}));
  const auto end = hn::Set(di, static_cast<std::int32_t>(end_of_front));
  CellBits bits;
  for (std::size_t k = 0; k < std::size_t{Tile::cell} * Tile::cell; k += hn::Lanes(dt)) {
    const auto its_place = hn::And(hn::Load(dt, tags + k), place);
    const auto shows = hn::Ne(its_place, hn::Zero(dt));
    const auto before = hn::RebindMask(dt, hn::Lt(hn::BitCast(di, its_place), end));
    bits.shown |= static_cast<std::uint32_t>(lane_bits(dt, shows)) << k;
    bits.front |= static_cast<std::uint32_t>(lane_bits(dt, hn::And(shows, before))) << k;
  }
  return bits;
}

void look_at_samples_in_lanes(const Tile& tile, TileRows& shown, TileRows& front) {
  shown.fill(0);
  front.fill(0);
  for (std::uint32_t top = 0; top < Tile::size; top += Tile::cell) {
    for (std::uint32_t left = 0; left < Tile::size; left += Tile::cell) {
      const CellBits bits = look_at_cell(tile.tags() + Tile::index(left, top), tile.end_of_front());
      for (std::uint32_t row = 0; row < Tile::cell; ++row) {
        const auto four = [&](std::uint32_t all) {
          return std::uint64_t{all >> (Tile::cell * row) & 15} << left;
        };
        shown[top + row] |= four(bits.shown);
        front[top + row] |= four(bits.front);
      }
    }
  }
}

void to_coverage_in_lanes(std::uint64_t row, float* values) {
  const DF df;
  const DT dt;
  const std::size_t lanes = hn::Lanes(df);
  const auto bit = hn::Shl(hn::Set(dt, 1), counting_lanes(dt));
  for (std::size_t column = 0; column < Tile::size; column += lanes) {
    const auto bits = hn::And(hn::Set(dt, static_cast<LaneTag>(row >> column)), bit);
    const auto is_set = hn::RebindMask(df, hn::Ne(bits, hn::Zero(dt)));
    hn::StoreU(hn::IfThenElseZero(is_set, hn::Set(df, 1.0F)), df, values + column);
  }
}

/// The bits of the columns first to last, which are integers in the tile, in the lanes of the mask.
HWY_INLINE hn::Vec<DU> columns_in_lanes(V first, V last, M some) {
  const DU du;
  const hn::RebindToSigned<DU> di;
  const auto all = hn::Set(du, ~std::uint64_t{0});
  const auto integer = [&](V x) HWY_ATTR {
    return hn::BitCast(du, hn::ConvertTo(di, hn::IfThenElseZero(some, x)));
  };
  const auto bits = hn::And(hn::Shl(all, integer(first)),
                            hn::Shr(all, hn::Sub(hn::Set(du, Tile::size - 1), integer(last))));
  return hn::IfThenElseZero(hn::RebindMask(du, some), bits);
}

/// Calls take(row, its bits) for each row of the box; bits_of_rows(middles of rows) returns the
/// bits of as many rows as there are lanes.
template <class BitsOfRows, class Take>
HWY_INLINE void for_rows(const TileBox& box, const BitsOfRows& bits_of_rows, const Take& take) {
  const DU du;
  HWY_ALIGN std::uint64_t bits[SetupBatch::most];
  for (int top = box.top; top <= box.bottom; top += static_cast<int>(hn::Lanes(du))) {
    hn::Store(bits_of_rows(counting_lanes(D(), top + 0.5)), du, bits);
    const int count = std::min(static_cast<int>(hn::Lanes(du)), box.bottom - top + 1);
    for (int k = 0; k < count; ++k)
      take(static_cast<std::size_t>(top) + static_cast<std::size_t>(k), bits[k]);
  }
}

HWY_INLINE V half_change(const UncertainHalfPlane& side) {
  return constant((std::abs(side.a) + std::abs(side.b)) / 2);
}

// A division finds where, in a row of pixels, a function is greater than its error at all four
// corners of a pixel; the two resulting ends are then tested. Products and sums are rounded
// monotonically, so a condition that holds at two pixels holds between them.
void add_pixels_inside_in_lanes(std::span<const UncertainHalfPlane> sides, const TileBox& box,
                                TileRows& rows) {
  const auto inside = [&](V middle) HWY_ATTR {
    V first = constant(box.left), last = constant(box.right);
    V least[5];
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto& [a, b, c, error] = sides[k];
      least[k] = hn::Sub(hn::Add(constant(c), hn::Mul(constant(b), middle)), half_change(sides[k]));
      const V root =
          hn::Sub(hn::Div(hn::Sub(constant(error), least[k]), constant(a)), constant(0.5));
      if (a > 0) first = hn::Max(first, hn::Add(hn::Floor(root), constant(1)));
      if (a < 0) last = hn::Min(last, hn::Sub(hn::Ceil(root), constant(1)));
    }
    M some = hn::Le(first, last);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto& side = sides[k];
      const auto is_inside = [&](V column) HWY_ATTR {
        const V f = hn::Add(least[k], hn::Mul(constant(side.a), hn::Add(column, constant(0.5))));
        return hn::Gt(f, constant(side.error));
      };
      some = hn::And(some, hn::And(is_inside(first), is_inside(last)));
    }
    return columns_in_lanes(first, last, some);
  };
  for_rows(box, inside, [&](std::size_t row, std::uint64_t bits) { rows[row] |= bits; });
}

// Likewise, with one more pixel on both sides for the rounding.
void find_pixels_met_in_lanes(std::span<const UncertainHalfPlane> sides, const TileBox& box,
                              TileRows& rows) {
  const auto met = [&](V middle) HWY_ATTR {
    V first = constant(box.left), last = constant(box.right);
    M some = hn::Le(first, last);
    for (const UncertainHalfPlane& side : sides) {
      const auto& [a, b, c, error] = side;
      const V greatest =
          hn::Add(hn::Add(hn::Add(constant(c), hn::Mul(constant(b), middle)), half_change(side)),
                  constant(error));
      const V root = hn::Sub(hn::Neg(hn::Div(greatest, constant(a))), constant(0.5));
      if (a > 0) first = hn::Max(first, hn::Sub(hn::Floor(root), constant(1)));
      if (a < 0) last = hn::Min(last, hn::Add(hn::Ceil(root), constant(1)));
      if (a == 0) some = hn::And(some, hn::Ge(greatest, constant(0)));
    }
    return columns_in_lanes(first, last, hn::And(some, hn::Le(first, last)));
  };
  for_rows(box, met, [&](std::size_t row, std::uint64_t bits) { rows[row] = bits; });
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(look_at_samples_in_lanes);
HWY_EXPORT(to_coverage_in_lanes);
HWY_EXPORT(add_pixels_inside_in_lanes);
HWY_EXPORT(find_pixels_met_in_lanes);

void look_at_samples(const Tile& tile, TileRows& shown, TileRows& front) {
  HWY_DYNAMIC_DISPATCH(look_at_samples_in_lanes)(tile, shown, front);
}

void to_coverage(std::uint64_t row, MapRow<float>& values) {
  HWY_DYNAMIC_DISPATCH(to_coverage_in_lanes)(row, values.data());
}

void add_pixels_inside(std::span<const UncertainHalfPlane> sides, const TileBox& box,
                       TileRows& rows) {
  HWY_DYNAMIC_DISPATCH(add_pixels_inside_in_lanes)(sides, box, rows);
}

void find_pixels_met(std::span<const UncertainHalfPlane> sides, const TileBox& box,
                     TileRows& rows) {
  HWY_DYNAMIC_DISPATCH(find_pixels_met_in_lanes)(sides, box, rows);
}

}  // namespace fathom::fast
#endif
