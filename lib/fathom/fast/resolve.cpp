// From the surfaces of a tile to the map.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/resolve.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/depth_interval-inl.h"
#include "fathom/fast/tile.h"

#ifndef FATHOM_FAST_RESOLVE_ROW
#define FATHOM_FAST_RESOLVE_ROW
namespace fathom::fast {
using namespace triangle;

/// One row of a tile: depths rounded to binary32, +∞ where there is no surface. A bit for each
/// column: whether it shows a surface, and whether its depth is not settled.
struct RoundedRow {
  std::array<float, Tile::size> depth;
  std::uint64_t surface = 0, open = 0;
};

}  // namespace fathom::fast
#endif

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

// If both ends of an interval that contains D round to the same number, so does D: rounding is
// monotone.
void round_row(const double* q_at, const std::uint64_t* tags, bool perspective, RoundedRow& row) {
  const D d;
  const DU du;
  const hn::Rebind<float, D> d32;
  const std::size_t lanes = hn::Lanes(d);
  const V none = constant(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < Tile::size; i += lanes) {
    const V q = hn::LoadU(d, q_at + i);
    const V error = hn::BitCast(d, hn::LoadU(du, tags + i));
    const DepthInterval D_interval =
        perspective ? perspective_depth(q, error) : orthographic_depth(q, error);
    const auto least = to_binary32(d32, D_interval.least);
    const V rounded = hn::PromoteTo(d, least);
    const V other = hn::PromoteTo(d, to_binary32(d32, D_interval.greatest));
    const M surface = hn::Gt(q, none);
    const M settled = hn::And(D_interval.known, hn::Eq(rounded, other));
    const V background = constant(std::numeric_limits<double>::infinity());
    hn::StoreU(to_binary32(d32, hn::IfThenElse(surface, rounded, background)), d32,
               row.depth.data() + i);
    row.surface |= std::uint64_t{bits_of(surface)} << i;
    row.open |= std::uint64_t{bits_of(hn::AndNot(settled, surface))} << i;
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(round_row);

std::optional<EncodingFault> Tile::resolve(CertifiedWriter& certified, float* depths,
                                           std::uint32_t image_width,
                                           const Context& context) const {
  const std::uint32_t columns = area_.last_column - area_.first_column + 1;
  static_assert(size == samples_of_row);
  RenderStatistics& statistics = context.statistics;
  for (std::uint32_t row = area_.first_row; row <= area_.last_row; ++row) {
    const std::size_t first = index(0, row - area_.first_row);
    VisibleRow visible;
    visible.lanes = {q() + first, tags() + first, area_.first_column + 0.5, row + 0.5};
    visible.first_pixel = static_cast<std::size_t>(row) * image_width + area_.first_column;
    RoundedRow rounded;
    HWY_DYNAMIC_DISPATCH(round_row)(q() + first, tags() + first, context.perspective, rounded);
    visible.surface = rounded.surface & ~std::uint64_t{0} >> (size - columns);
    if (context.doubtful) {
      for (std::uint64_t bits = visible.surface & rounded.open; bits != 0; bits &= bits - 1) {
        context.note_doubt(area_.first_column + static_cast<std::uint32_t>(std::countr_zero(bits)),
                           row);
      }
    }
    statistics.pixels_with_surface += static_cast<std::uint64_t>(std::popcount(visible.surface));
    if (depths) {
      std::copy_n(rounded.depth.data(), columns, depths + visible.first_pixel);
      const std::uint64_t settled = visible.surface & ~rounded.open;
      statistics.rounding.interval += static_cast<std::uint64_t>(std::popcount(settled));
      visible.surface &= rounded.open;
    }
    if (visible.surface == 0) continue;
    if (auto fault = certified.write(visible, context.referee, statistics)) return fault;
  }
  return std::nullopt;
}

}  // namespace fathom::fast
#endif
