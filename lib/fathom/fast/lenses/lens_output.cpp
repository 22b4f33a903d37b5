#include "fathom/fast/lenses/lens_output.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/lanes/each_bit.h"

namespace fathom::fast {
using namespace triangle;

namespace {

constexpr std::size_t not_written = std::numeric_limits<std::size_t>::max();

bool are_depths_only(const rendering::ChannelValues& values) {
  return !values.distance.wanted() && !values.low && !values.shading_normal[0] &&
         !values.position[0] && !values.barycentric[0] && !values.depth.binary64 &&
         !values.depth.codes;
}

bool has_others(const rendering::ChannelValues& values) {
  return values.id || values.wants_origins() || values.normal[0] || values.camera_normal[0];
}

}  // namespace

LensOutput::LensOutput(ChannelWriter& writer, std::uint32_t width)
    : writer_(writer),
      width_(width),
      depths_only_(are_depths_only(writer.values())),
      others_(has_others(writer.values())) {}

void LensOutput::write_valid(const PixelBox& area, const Places::OfTile& places) const {
  std::uint32_t* const valid = writer_.values().valid;
  if (valid == nullptr) return;
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
      const std::size_t i = Tile::index(column - area.first_column, row - area.first_row);
      valid[std::size_t{row} * width_ + column] = places.x[i] == places.x[i] ? 1 : 0;
    }
  }
}

void LensOutput::copy_what_is_the_same(std::size_t from, std::size_t to) const {
  const rendering::ChannelValues& values = writer_.values();
  const auto copy = [&](auto* channel) {
    if (channel) channel[to] = channel[from];
  };
  copy(values.id);
  for (auto* const channel : values.origins()) copy(channel);
  for (auto* const channel : values.normal) copy(channel);
  for (auto* const channel : values.camera_normal) copy(channel);
}

void LensOutput::write_what_is_the_same(std::size_t pixel, std::uint32_t number,
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
    std::copy_n(values.data(), columns, depths + (std::size_t{row} * width_ + area.first_column));
  }
}

std::optional<EncodingFault> LensOutput::write_along_ray(const LensTile& tile, std::size_t i,
                                                         std::size_t pixel,
                                                         const LensContext& context) const {
  const auto ray = context.preimages.of_pixel(static_cast<std::uint32_t>(pixel % width_),
                                              static_cast<std::uint32_t>(pixel / width_));
  const std::uint32_t number = tile.tile().surface_at(i).number();
  return writer_.write(pixel, context.referee.projected(number), *ray);
}

void LensOutput::write_others(const LensTile& tile, std::size_t i, std::size_t pixel,
                              const LensContext& context) {
  std::size_t& first = first_pixel_[Tile::place_of(tile.tile().tags()[i])];
  if (first != not_written) {
    copy_what_is_the_same(first, pixel);
  } else {
    write_what_is_the_same(pixel, tile.tile().surface_at(i).number(), context);
    first = pixel;
  }
}

// Normals and numbers are those of the first pixel of a surface, once for each tile. Other
// channels, and depths that are not settled, are values along the exact ray.
std::optional<EncodingFault> LensOutput::write(const LensTile& tile, const LensContext& context) {
  const PixelBox& area = tile.tile().area();
  RenderStatistics& statistics = context.window.statistics;
  write_valid(area, tile.places());
  round_depths(tile, rounded_);
  float* const depths = writer_.values().depth.binary32;
  if (depths) write_depths(area);
  first_pixel_.assign(tile.tile().end_of_places(), not_written);
  std::optional<EncodingFault> fault;
  for (std::size_t word = 0; word < rounded_.surface.size(); ++word) {
    const std::uint64_t shown = rounded_.surface[word];
    const std::uint64_t along_rays = !depths_only_ ? shown
                                     : depths      ? rounded_.open[word]
                                                   : std::uint64_t{0};
    const auto count = [](std::uint64_t bits) {
      return static_cast<std::uint64_t>(std::popcount(bits));
    };
    statistics.pixels_with_surface += count(shown);
    statistics.rounding.interval += count(shown & ~along_rays);
    statistics.rounding.exact += count(along_rays);
    const auto pixel_of = [&](std::size_t i) {
      return (std::size_t{area.first_row} + Tile::row_of(i)) * width_ + area.first_column +
             Tile::column_of(i);
    };
    for (const std::size_t k : EachBit(along_rays)) {
      const std::size_t i = 64 * word + k;
      auto found = write_along_ray(tile, i, pixel_of(i), context);
      if (found && (!fault || found->pixel < fault->pixel)) fault = std::move(found);
    }
    if (!others_) continue;
    for (const std::size_t k : EachBit(shown & ~along_rays))
      write_others(tile, 64 * word + k, pixel_of(64 * word + k), context);
  }
  return fault;
}

}  // namespace fathom::fast
