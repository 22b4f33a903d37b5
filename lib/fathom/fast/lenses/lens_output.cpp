#include "fathom/fast/lenses/lens_output.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/fast/lanes/each_bit.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {
using namespace triangle;

namespace {

constexpr std::size_t not_written = std::numeric_limits<std::size_t>::max();

bool has_triangle_channels(const rendering::ChannelValues& values) {
  return values.id || values.wants_origins() || values.normal[0] || values.camera_normal[0];
}

}  // namespace

LensOutput::LensOutput(ChannelWriter& writer, const MapLayout& layout)
    : writer_(writer),
      layout_(layout),
      needs_exact_rays_(writer.values().shading_normal[0] != nullptr),
      needs_double_words_(WideValues::are_wanted(writer.values())),
      along_rays_(writer.values()),
      others_(has_triangle_channels(writer.values())) {}

void LensOutput::copy_triangle_channels(std::size_t from, std::size_t to) const {
  const rendering::ChannelValues& values = writer_.values();
  const auto copy = [&](auto* channel) {
    if (channel) channel[to] = channel[from];
  };
  copy(values.id);
  for (auto* const channel : values.origins()) copy(channel);
  for (auto* const channel : values.normal) copy(channel);
  for (auto* const channel : values.camera_normal) copy(channel);
}

void LensOutput::write_triangle_channels(std::size_t pixel, std::uint32_t number,
                                         const LensContext& context) const {
  writer_.write_origin(pixel, number);
  const rendering::ChannelValues& values = writer_.values();
  if (!values.normal[0] && !values.camera_normal[0]) return;
  const ProjectedTriangle& t = context.referee.projected(number);
  if (values.normal[0]) writer_.write_normal(pixel, t);
  if (values.camera_normal[0]) writer_.write_camera_normal(pixel, t);
}

void LensOutput::write_depths(const PixelBox& area) const {
  float* const depths = writer_.values().depth.binary32;
  const std::uint32_t columns = area.last_column - area.first_column + 1;
  MapRow<float> values;
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    for (std::uint32_t column = 0; column < Tile::size; column += Tile::cell) {
      const std::size_t i = Tile::index(column, row - area.first_row);
      std::copy_n(rounded_.depths.data() + i, Tile::cell, values.data() + column);
    }
    MapRows().write(values, columns, depths + layout_.pixel(area.first_column, row));
  }
}

void LensOutput::write_depth(std::size_t i, std::size_t pixel) const {
  const rendering::EncodedValues& values = writer_.values().depth;
  if (values.codes) {
    values.codes[pixel] = static_cast<std::uint16_t>(rounded_.depths[i]);
  } else {
    values.binary32[pixel] = rounded_.depths[i];
  }
}

std::size_t LensOutput::pixel_of(const LensTile& tile, std::size_t i) const {
  const PixelBox& area = tile.tile().area();
  return layout_.pixel(area.first_column + Tile::column_of(i), area.first_row + Tile::row_of(i));
}

std::optional<EncodingFault> LensOutput::write_along_ray(const LensTile& tile, std::size_t i,
                                                         const LensContext& context) const {
  const PixelBox& area = tile.tile().area();
  const auto ray = context.preimages.of_pixel(area.first_column + Tile::column_of(i),
                                              area.first_row + Tile::row_of(i));
  const std::uint32_t number = tile.tile().surface_at(i).number();
  return writer_.write(pixel_of(tile, i), context.referee.projected(number), *ray);
}

// The place (x, y) is the direction x·right + y·down + forward.
bool LensOutput::write_in_binary64(const LensTile& tile, std::size_t i, std::size_t pixel,
                                   const RaySurface::Wanted& wanted, const LensContext& context) {
  std::optional<RaySurface>& surface = surfaces_[Tile::place_of(tile.tile().tags()[i])];
  if (!surface)
    surface.emplace(context.referee.projected(tile.tile().surface_at(i).number()), wanted);
  const Places::OfTile& places = tile.places();
  const auto around = [&](double x) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return Interval{std::nextafter(x - places.error, -infinity),
                    std::nextafter(x + places.error, infinity)};
  };
  RayBox box;
  const auto set = [&box](const ViewAxes::Axis& axis, const Interval& interval) {
    box[axis.of_camera] = axis.sign > 0 ? interval : Interval{-interval.upper, -interval.lower};
  };
  set(context.axes.right, around(places.x[i]));
  set(context.axes.down, around(places.y[i]));
  set(context.axes.forward, {1, 1});
  return surface->write(pixel, box, writer_.values(), writer_.code_factor());
}

bool LensOutput::write_in_double_words(const LensTile& tile, std::size_t i, std::size_t pixel,
                                       const LensContext& context) {
  const std::optional<lens::DirectionWords> direction = direction_at(tile, i, context);
  return direction &&
         wide_values_->write(pixel, Tile::place_of(tile.tile().tags()[i]),
                             tile.tile().surface_at(i).number(), *direction, writer_.values());
}

std::optional<lens::DirectionWords> LensOutput::direction_at(const LensTile& tile, std::size_t i,
                                                             const LensContext& context) {
  const PixelBox& area = tile.tile().area();
  const std::uint32_t column = area.first_column + Tile::column_of(i);
  const std::uint32_t row = area.first_row + Tile::row_of(i);
  if (const auto direction = formulas_->of_pixel(column, row, starts_->at(i))) return direction;
  return context.preimages.of_pixel(column, row)->words();
}

void LensOutput::prepare_double_words(const LensTile& tile, const LensContext& context) {
  wide_values_.emplace(context.window_rays, context.window_camera, context.axes);
  wide_values_->start(tile.tile().end_of_places());
  if (!formulas_) {
    formulas_.emplace(context.preimages);
    starts_.emplace(context.preimages);
  }
  starts_->start(tile.places(), context.axes);
}

void LensOutput::write_others(const LensTile& tile, std::size_t i, std::size_t pixel,
                              const LensContext& context) {
  std::size_t& first = first_pixel_[Tile::place_of(tile.tile().tags()[i])];
  if (first != not_written) {
    copy_triangle_channels(first, pixel);
  } else {
    write_triangle_channels(pixel, tile.tile().surface_at(i).number(), context);
    first = pixel;
  }
}

// Normals and numbers are those of the first pixel of a surface, once for each tile. Other
// channels are settled in binary64 for all rays within the error of the place, or in double-words,
// or else, with depths that are not settled, computed along the exact ray.
std::optional<EncodingFault> LensOutput::write(const LensTile& tile, const LensContext& context) {
  const PixelBox& area = tile.tile().area();
  const rendering::EncodedValues& depth_values = writer_.values().depth;
  depth_values.codes ? round_to_codes(tile, writer_.code_factor(), rounded_)
                     : round_depths(tile, rounded_);
  const Depths depths = depths_of(tile, context);
  if (depths == Depths::in_rows) write_depths(area);
  RaySurface::Wanted wanted = along_rays_;
  wanted.depth = depths == Depths::along_rays;
  first_pixel_.assign(tile.tile().end_of_places(), not_written);
  surfaces_.clear();
  if (wanted.any()) surfaces_.resize(tile.tile().end_of_places());
  if (needs_double_words_) prepare_double_words(tile, context);
  std::optional<EncodingFault> fault;
  RenderStatistics& statistics = context.window.statistics;
  for (std::size_t word = 0; word < rounded_.surface.size(); ++word) {
    for (const std::size_t k : EachBit(work_at(word, depths, statistics))) {
      const std::size_t i = 64 * word + k;
      const std::size_t pixel = pixel_of(tile, i);
      const bool from_q = depths == Depths::in_rows || depths == Depths::by_sample;
      const bool is_open = needs_exact_rays_ || (from_q && rounded_.is_open(i));
      if (is_open || (wanted.any() && !write_in_binary64(tile, i, pixel, wanted, context)) ||
          (needs_double_words_ && !write_in_double_words(tile, i, pixel, context))) {
        ++statistics.rounding.exact;
        context.window.note_doubt(area.first_column + Tile::column_of(i),
                                  area.first_row + Tile::row_of(i));
        auto found = write_along_ray(tile, i, context);
        if (found && (!fault || found->pixel < fault->pixel)) fault = std::move(found);
      } else {
        ++statistics.rounding.interval;
        if (needs_double_words_) ++statistics.double_word_roundings;
        if (depths == Depths::by_sample) write_depth(i, pixel);
        if (others_) write_others(tile, i, pixel, context);
      }
    }
  }
  return fault;
}

LensOutput::Depths LensOutput::depths_of(const LensTile& tile, const LensContext& context) const {
  const rendering::EncodedValues& depth = writer_.values().depth;
  if (depth.binary32 == nullptr && depth.codes == nullptr) return Depths::none;
  if (!context.axes.is_of_camera()) return Depths::along_rays;
  if (depth.codes != nullptr) return Depths::by_sample;
  return tile.places().is_whole ? Depths::in_rows : Depths::by_sample;
}

std::uint64_t LensOutput::work_at(std::size_t word, Depths depths,
                                  RenderStatistics& statistics) const {
  const std::uint64_t shown = rounded_.surface[word];
  const auto count = [](std::uint64_t bits) {
    return static_cast<std::uint64_t>(std::popcount(bits));
  };
  statistics.pixels_with_surface += count(shown);
  const bool by_sample = depths == Depths::by_sample || depths == Depths::along_rays;
  const bool along_rays = needs_exact_rays_ || needs_double_words_ || along_rays_.any();
  if (along_rays || others_ || by_sample) return shown;
  const std::uint64_t open = depths == Depths::in_rows ? rounded_.open[word] : 0;
  statistics.rounding.interval += count(shown & ~open);
  return open;
}

namespace {

/// The visible triangle along a ray.
std::optional<std::uint32_t> nearest_along(const lens::ExactDirection& d,
                                           const std::vector<std::uint32_t>& triangles,
                                           RayReferee& referee, RenderStatistics& statistics) {
  std::optional<std::uint32_t> nearest;
  for (const std::uint32_t number : triangles) {
    ++statistics.samples_tested;
    if (!referee.covers(number, d, statistics)) continue;
    if (!referee.is_in_range(number, d, statistics)) continue;
    ++statistics.samples_covered;
    if (!nearest || referee.hides(number, *nearest, d, statistics)) nearest = number;
  }
  return nearest;
}

}  // namespace

RayByRay::RayByRay(const TriangleSource& triangles, const Camera& camera, Cull cull,
                   const lens::Preimages& preimages)
    : triangles_(triangles), camera_(camera), preimages_(preimages) {
  RayReferee referee(triangles, camera);
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const ProjectedTriangle& t = referee.projected(number);
    if (t.orientation != Sign::zero && is_kept(t, cull)) kept_.push_back(number);
  }
}

void RayByRay::count(std::span<const std::uint32_t> numbers, RenderStatistics& statistics) const {
  RayReferee referee(triangles_, camera_);
  for (const std::uint32_t number : numbers) {
    if (std::ranges::binary_search(kept_, number)) continue;
    const bool is_degenerate = referee.projected(number).orientation == Sign::zero;
    ++(is_degenerate ? statistics.degenerate_triangles : statistics.culled_triangles);
  }
}

void RayByRay::write(const PixelBox& area, const MapLayout& layout, ChannelWriter& writer,
                     RenderStatistics& statistics, FirstFault& fault) const {
  std::vector<RenderStatistics> of_rows(area.last_row - area.first_row + 1);
  parallel_for(area.first_row, area.last_row + 1, [&](std::uint32_t row) {
    RayReferee referee(triangles_, camera_);
    RenderStatistics& of_row = of_rows[row - area.first_row];
    for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
      const std::size_t pixel = layout.pixel(column, row);
      const auto d = preimages_.of_pixel(column, row);
      if (std::uint32_t* const valid = writer.values().valid) valid[pixel] = d ? 1 : 0;
      if (!d) continue;
      const auto nearest = nearest_along(*d, kept_, referee, of_row);
      if (!nearest) continue;
      ++of_row.pixels_with_surface;
      fault.add(writer.write(pixel, referee.projected(*nearest), *d));
    }
  });
  for (const RenderStatistics& part : of_rows) add(statistics, part);
}

}  // namespace fathom::fast
