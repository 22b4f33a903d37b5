// From the surfaces of a tile to the map.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/resolve.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/counting_lanes-inl.h"
#include "fathom/fast/depth_interval-inl.h"
#include "fathom/fast/lane_batch-inl.h"
#include "fathom/fast/tile.h"

#ifndef FATHOM_FAST_RESOLVE_ROW
#define FATHOM_FAST_RESOLVE_ROW
namespace fathom::fast {
using namespace triangle;

/// A bit for each column of a row of a tile: whether it shows a surface, and whether its depth is
/// not settled.
struct RowBits {
  std::uint64_t surface = 0, open = 0;
};

/// What is visible along a row of a tile: q in binary64, tags, and places of the surfaces.
struct SurfacesOfRow {
  alignas(64) std::array<double, Tile::size> q{};
  alignas(64) std::array<std::uint64_t, Tile::size> tags{};
  alignas(64) std::array<std::uint32_t, Tile::size> places{};
};

}  // namespace fathom::fast
#endif

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// For as many samples of a row as there are lanes of binary64.
using D32 = hn::Rebind<float, D>;
using DT32 = hn::Rebind<LaneTag, D>;

HWY_INLINE hn::Vec<DT32> lane_tags_at(const Tile& tile, std::uint32_t column, std::uint32_t row) {
  const LaneTag* const first = tile.tags() + Tile::index(column, row);
#if HWY_HAVE_SCALABLE
  // A vector may be longer than a row of a cell, and no constant tells whether it is.
  HWY_ALIGN LaneTag tags[SetupBatch::most];
  for (std::uint32_t k = 0; k < hn::Lanes(D()); ++k) {
    tags[k] = tile.tags()[Tile::index(column + k, row)];
  }
  return hn::Load(DT32(), tags);
#else
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) == 2 * Tile::cell) {
    // Cells that are next to each other in a row are so in memory.
    const hn::Half<DT32> d;
    return hn::Combine(DT32(), hn::Load(d, first + Tile::cell * Tile::cell), hn::Load(d, first));
  }
#endif
  return hn::LoadU(DT32(), first);
#endif
}

struct Surfaces {
  V q;
  hn::Vec<DU> tag;
};

HWY_INLINE Surfaces surfaces_of(const Tile& tile, hn::Vec<DT32> tags, std::uint32_t column,
                                std::uint32_t row) {
  const DT32 dt;
  const TileSurface* const surfaces = tile.surfaces();
  const V x = counting_lanes(D(), static_cast<double>(column)), y = constant(row);
  const LaneTag first = hn::GetLane(tags);
  if (hn::AllTrue(dt, hn::Eq(tags, hn::Set(dt, first)))) {
    const TileSurface& s = surfaces[Tile::place_of(first)];
    return {hn::MulAdd(constant(s.b), y, hn::MulAdd(constant(s.a), x, constant(s.c))),
            hn::Set(DU(), s.tag)};
  }
  HWY_ALIGN LaneTag tag_of[SetupBatch::most];
  hn::Store(tags, dt, tag_of);
  const Records r = load_records(
      [&](std::size_t lane) HWY_ATTR { return &surfaces[Tile::place_of(tag_of[lane])].c; });
  return {hn::MulAdd(r.third, y, hn::MulAdd(r.second, x, r.first)), hn::BitCast(DU(), r.fourth)};
}

HWY_INLINE void store(const Surfaces& s, hn::Vec<DT32> places, std::uint32_t column,
                      SurfacesOfRow& row) {
  hn::Store(s.q, D(), row.q.data() + column);
  hn::Store(s.tag, DU(), row.tags.data() + column);
  hn::Store(places, DT32(), row.places.data() + column);
}

/// Which samples of a row show a surface, and which.
std::uint64_t look_at_row(const Tile& tile, std::uint32_t row, SurfacesOfRow& surfaces) {
  const DT32 dt;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(D()));
  const auto place = hn::Set(dt, Tile::place_of(~LaneTag{0}));
  std::uint64_t shown = 0;
  for (std::uint32_t column = 0; column < Tile::size; column += lanes) {
    const auto tags = lane_tags_at(tile, column, row);
    const auto places = hn::And(tags, place);
    const auto surface = hn::Ne(places, hn::Zero(dt));
    if (hn::AllFalse(dt, surface)) {
      hn::Store(places, dt, surfaces.places.data() + column);
      continue;
    }
    store(surfaces_of(tile, tags, column, row), places, column, surfaces);
    shown |= std::uint64_t{lane_bits(dt, surface)} << column;
  }
  return shown;
}

// If both ends of an interval that contains D round to the same number, so does D: rounding is
// monotone.
template <bool perspective>
HWY_INLINE RowBits round_row(const Tile& tile, std::uint32_t row, float* depths,
                             SurfacesOfRow* surfaces) {
  const D d;
  const D32 d32;
  const DT32 dt;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const auto background = hn::Set(d32, std::numeric_limits<float>::infinity());
  const auto no_place = hn::Zero(dt), place = hn::Set(dt, Tile::place_of(~LaneTag{0}));
  RowBits bits;
  for (std::uint32_t column = 0; column < Tile::size; column += lanes) {
    const auto tags = lane_tags_at(tile, column, row);
    const auto places = hn::And(tags, place);
    const auto surface = hn::Ne(places, no_place);
    if (hn::AllFalse(dt, surface)) {
      if (surfaces) hn::Store(places, dt, surfaces->places.data() + column);
      hn::StoreU(background, d32, depths + column);
      continue;
    }
    const Surfaces s = surfaces_of(tile, tags, column, row);
    if (surfaces) store(s, places, column, *surfaces);
    const V error = hn::BitCast(d, s.tag);
    const DepthInterval D_interval =
        perspective ? perspective_depth(s.q, error) : orthographic_depth(s.q, error);
    const auto least = to_binary32(d32, D_interval.least);
    const auto greatest = to_binary32(d32, D_interval.greatest);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(d32, surface), least, background), d32,
               depths + column);
    const unsigned shown = lane_bits(dt, surface);
    const unsigned settled = bits_of(D_interval.known) & lane_bits(d32, hn::Eq(least, greatest));
    bits.surface |= std::uint64_t{shown} << column;
    bits.open |= std::uint64_t{shown & ~settled} << column;
  }
  return bits;
}

/// Writes the depths of a row rounded to binary32, +∞ where there is no surface; those that are open
/// mean nothing. `surfaces`: filled if not null.
RowBits round_depths_of_row(const Tile& tile, std::uint32_t row, bool perspective, float* depths,
                            SurfacesOfRow* surfaces) {
  return perspective ? round_row<true>(tile, row, depths, surfaces)
                     : round_row<false>(tile, row, depths, surfaces);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(look_at_row);
HWY_EXPORT(round_depths_of_row);

namespace {

RowBits write_depths(const Tile& tile, std::uint32_t row, float* depths, const MapRows& rows,
                     const Tile::Context& context, SurfacesOfRow* surfaces) {
  const std::uint32_t columns = tile.area().last_column - tile.area().first_column + 1;
  MapRow<float> rounded;
  const RowBits bits = HWY_DYNAMIC_DISPATCH(round_depths_of_row)(tile, row, context.perspective,
                                                                 rounded.data(), surfaces);
  rows.write(rounded, columns, depths);
  const std::uint64_t within = ~std::uint64_t{0} >> (Tile::size - columns);
  return {bits.surface & within, bits.open & within};
}

void note_doubts(std::uint64_t open, const PixelBox& area, std::uint32_t row,
                 const Tile::Context& context) {
  for (; context.doubtful && open != 0; open &= open - 1) {
    context.note_doubt(area.first_column + static_cast<std::uint32_t>(std::countr_zero(open)), row);
  }
}

void write_background(const Tile::Output& output, std::size_t first_pixel, std::uint32_t columns) {
  output.unfilled.for_each([&](auto* values, auto background) {
    MapRow<decltype(background)> pixels;
    pixels.fill(background);
    output.certified.rows().write(pixels, columns, values + first_pixel);
  });
}

}  // namespace

std::optional<EncodingFault> Tile::resolve(const Output& output, const Context& context) const {
  const std::uint32_t columns = area_.last_column - area_.first_column + 1;
  const std::uint64_t whole_row = ~std::uint64_t{0} >> (size - columns);
  RenderStatistics& statistics = context.statistics;
  const MapRows& rows = output.certified.rows();
  SurfacesOfRow surfaces;
  output.certified.start(*this, output.image_width, context.referee, statistics);
  for (std::uint32_t row = area_.first_row; row <= area_.last_row; ++row) {
    const std::uint32_t tile_row = row - area_.first_row;
    VisibleRow visible;
    visible.columns = columns;
    visible.first_pixel = static_cast<std::size_t>(row) * output.image_width + area_.first_column;
    if (output.depths) {
      const RowBits bits = write_depths(*this, tile_row, output.depths + visible.first_pixel, rows,
                                        context, output.others ? &surfaces : nullptr);
      note_doubts(bits.open, area_, row, context);
      visible.surface = bits.surface;
      visible.open_depth = bits.open;
    } else {
      visible.surface = HWY_DYNAMIC_DISPATCH(look_at_row)(*this, tile_row, surfaces) & whole_row;
      visible.open_depth = visible.surface;
    }
    statistics.pixels_with_surface += static_cast<std::uint64_t>(std::popcount(visible.surface));
    statistics.rounding.interval +=
        static_cast<std::uint64_t>(std::popcount(visible.surface & ~visible.open_depth));
    if (visible.surface == 0) {
      write_background(output, visible.first_pixel, columns);
      continue;
    }
    if (!output.others) {
      visible.surface = visible.open_depth;
      if (visible.surface == 0) continue;
      HWY_DYNAMIC_DISPATCH(look_at_row)(*this, tile_row, surfaces);
    }
    visible.lanes = {surfaces.q.data(), surfaces.tags.data(), surfaces.places.data(),
                     area_.first_column + 0.5, row + 0.5};
    if (auto fault = output.certified.write(visible, context.referee, statistics)) return fault;
  }
  rows.finish();
  return std::nullopt;
}

}  // namespace fathom::fast
#endif
