// From the surfaces of a tile to the map.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/channels/resolve.cpp"
#include "fathom/fast/channels/resolve.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "fathom/fast/channels/depth_interval-inl.h"
#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/tiles/lane_batch-inl.h"
#include "fathom/fast/tiles/tile.h"

#ifndef FATHOM_FAST_RESOLVE_ROW
#define FATHOM_FAST_RESOLVE_ROW
namespace fathom::fast {
using namespace triangle;

/// A bit for each column of a row of a tile: whether it shows a surface, and whether its depth is
/// not settled.
struct RowBits {
  std::uint64_t surface = 0, open = 0;
};

/// The visible surfaces along a row of a tile: q in binary64, tags, and places of the surfaces.
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

HWY_INLINE hn::Vec<DT32> lane_tags_at(const Tile& tile, std::uint32_t column, std::uint32_t row) {
  const LaneTag* const first = tile.tags() + Tile::index(column, row);
#if HWY_HAVE_SCALABLE
  // A vector may be longer than a row of a cell, and no constant shows whether it is.
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

HWY_INLINE void store(const Surfaces& s, hn::Vec<DT32> places, std::uint32_t column,
                      SurfacesOfRow& row) {
  hn::Store(s.q, D(), row.q.data() + column);
  hn::Store(s.tag, DU(), row.tags.data() + column);
  hn::Store(places, DT32(), row.places.data() + column);
}

/// Calls shown(column, surfaces, which lanes show one) for as many samples of a row at once as
/// there are lanes, or empty(column) where none of them shows a surface. `surfaces`: filled if not
/// null. Returns which samples show one.
template <class Shown, class Empty>
HWY_INLINE std::uint64_t look_at_row(const Tile& tile, std::uint32_t row, SurfacesOfRow* surfaces,
                                     const Shown& shown, const Empty& empty) {
  const DT32 dt;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(D()));
  const auto place = hn::Set(dt, Tile::place_of(~LaneTag{0}));
  std::uint64_t with_surface = 0;
  for (std::uint32_t column = 0; column < Tile::size; column += lanes) {
    const auto tags = lane_tags_at(tile, column, row);
    const auto places = hn::And(tags, place);
    const auto surface = hn::Ne(places, hn::Zero(dt));
    if (hn::AllFalse(dt, surface)) {
      if (surfaces) hn::Store(places, dt, surfaces->places.data() + column);
      empty(column);
      continue;
    }
    const Surfaces s = surfaces_at(tile.surfaces(), tags,
                                   counting_lanes(D(), static_cast<double>(column)), constant(row));
    if (surfaces) store(s, places, column, *surfaces);
    with_surface |= std::uint64_t{lane_bits(dt, surface)} << column;
    shown(column, s, surface);
  }
  return with_surface;
}

/// Which samples of a row show a surface, and which.
std::uint64_t find_surfaces_of_row(const Tile& tile, std::uint32_t row, SurfacesOfRow& surfaces) {
  return look_at_row(
      tile, row, &surfaces, [](std::uint32_t, const Surfaces&, hn::Mask<DT32>) HWY_ATTR {},
      [](std::uint32_t) HWY_ATTR {});
}

// If both ends of an interval that contains D round to the same number, so does D: rounding is
// monotone.
template <bool perspective>
HWY_INLINE RowBits round_row(const Tile& tile, std::uint32_t row, float* depths,
                             SurfacesOfRow* surfaces) {
  const D32 d32;
  const auto background = hn::Set(d32, std::numeric_limits<float>::infinity());
  RowBits bits;
  bits.surface = look_at_row(
      tile, row, surfaces,
      [&](std::uint32_t column, const Surfaces& s, hn::Mask<DT32> surface) HWY_ATTR {
        const V error = hn::BitCast(D(), s.tag);
        const DepthInterval D_interval =
            perspective ? perspective_depth(s.q, error) : orthographic_depth(s.q, error);
        const auto least = to_binary32(D_interval.least);
        const auto greatest = to_binary32(D_interval.greatest);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(d32, surface), least, background), d32,
                   depths + column);
        const unsigned settled =
            bits_of(D_interval.known) & lane_bits(d32, hn::Eq(least, greatest));
        bits.open |= std::uint64_t{lane_bits(DT32(), surface) & ~settled} << column;
      },
      [&](std::uint32_t column) HWY_ATTR { hn::StoreU(background, d32, depths + column); });
  return bits;
}

/// Writes the depths of a row rounded to binary32, +∞ where there is no surface; open depths are
/// meaningless. `surfaces`: filled if not null.
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

HWY_EXPORT(find_surfaces_of_row);
HWY_EXPORT(round_depths_of_row);

namespace {

RowBits write_depths(const Tile& tile, std::uint32_t row, float* depths, std::size_t columns,
                     const MapRows& rows, const DrawContext& context, SurfacesOfRow* surfaces) {
  MapRow<float> rounded;
  const RowBits bits = HWY_DYNAMIC_DISPATCH(round_depths_of_row)(tile, row, context.perspective,
                                                                 rounded.data(), surfaces);
  rows.write(rounded, columns, depths);
  return bits;
}

void note_doubts(std::uint64_t open, const PixelBox& area, std::uint32_t row,
                 const DrawContext& context) {
  if (!context.doubtful) return;
  for (const std::size_t k : EachBit(open)) {
    context.note_doubt(area.first_column + static_cast<std::uint32_t>(k), row);
  }
}

}  // namespace

std::optional<EncodingFault> resolve(const Tile& tile, const TileOutput& output,
                                     const DrawContext& context) {
  const PixelBox& area = tile.area();
  const std::uint32_t columns = area.last_column - area.first_column + 1;
  RenderStatistics& statistics = context.statistics;
  const MapRows& rows = output.certified.rows();
  SurfacesOfRow surfaces;
  output.certified.start(tile, output.layout, context.referee, statistics);
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    const std::uint32_t tile_row = row - area.first_row;
    VisibleRow visible;
    visible.columns = columns;
    visible.first_pixel = output.layout.pixel(area.first_column, row);
    if (output.depths) {
      const RowBits bits =
          write_depths(tile, tile_row, output.depths + visible.first_pixel, columns, rows, context,
                       output.others ? &surfaces : nullptr);
      visible.surface = bits.surface & visible.all();
      visible.open_depth = bits.open & visible.all();
      note_doubts(visible.open_depth, area, row, context);
    } else {
      visible.surface =
          HWY_DYNAMIC_DISPATCH(find_surfaces_of_row)(tile, tile_row, surfaces) & visible.all();
      visible.open_depth = visible.surface;
    }
    statistics.pixels_with_surface += static_cast<std::uint64_t>(std::popcount(visible.surface));
    statistics.rounding.interval +=
        static_cast<std::uint64_t>(std::popcount(visible.surface & ~visible.open_depth));
    if (visible.surface == 0) {
      if (output.others) {
        output.background.write({area.first_column, area.last_column, row, row}, output.layout);
      }
      continue;
    }
    if (!output.others) {
      visible.surface = visible.open_depth;
      if (visible.surface == 0) continue;
      HWY_DYNAMIC_DISPATCH(find_surfaces_of_row)(tile, tile_row, surfaces);
    }
    visible.lanes = {surfaces.q.data(), surfaces.tags.data(), surfaces.places.data(),
                     area.first_column + 0.5, row + 0.5};
    if (auto fault = output.certified.write(visible, context.referee, statistics)) return fault;
  }
  rows.finish();
  return std::nullopt;
}

namespace {

/// The channels whose background tiles that show surfaces do not write anyway.
rendering::MapBackground beside_surfaces(rendering::MapBackground background, bool writes_depths) {
  background.leave_out("A");
  if (writes_depths) background.leave_out("Z");
  return background;
}

}  // namespace

FastOutput::FastOutput(DepthMap& map, ChannelWriter& writer, const SceneRays& rays,
                       rendering::MapBackground unfilled, MapRows rows)
    : rows_(rows),
      certified_([&, rows] { return CertifiedWriter(writer, rays, rows); }),
      depths_(writer.values().depth.binary32),
      others_(std::any_of(map.channels.begin(), map.channels.end(),
                          [&](const ImageChannel& channel) {
                            return channel.name != "A" && !(depths_ && channel.name == "Z");
                          })),
      all_(unfilled, rows),
      beside_surfaces_(beside_surfaces(std::move(unfilled), depths_ != nullptr), rows) {}

void FastOutput::write_background(const PixelBox& area, const MapLayout& layout) const {
  all_.write(area, layout);
  rows_.finish();
}

}  // namespace fathom::fast
#endif
