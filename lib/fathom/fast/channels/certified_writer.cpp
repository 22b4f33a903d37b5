#include "fathom/fast/channels/certified_writer.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/tiles/tile.h"

// How to read this file: CertifiedWriter::write() is the list of channels. Channels that follow
// from q alone are rounded for a whole row (channel_rows.h), and so are channels that follow from
// the triangle (surface_lanes.h, wide_rows.h), with the properties that TileSurfaces computes. For
// the remaining values, PixelWriter has a function for each channel, which goes through the tiers.
// Values and their bounds come from triangle/certified_surface.h and double_word_surface.h,
// roundings from numeric/certified_rounding.h.
namespace fathom::fast {

void TileSurfaces::start(const Tile& tile) {
  left_ = tile.area().first_column + 0.5;
  top_ = tile.area().first_row + 0.5;
  index_at_.assign(tile.end_of_places(), 0);
  // Neighbours mostly show one surface.
  constexpr std::size_t together = 16, samples = Tile::samples;
  LaneTag last = no_surface_lane_tag;
  for (std::size_t first = 0; first < samples; first += together) {
    const std::span<const LaneTag> tags(tile.tags() + first, together);
    bool same = true;
    for (const LaneTag tag : tags) same &= tag == last;
    if (same) continue;
    // Where they do not, a branch for each would mostly be guessed wrong.
    for (std::size_t k = 0; k < together; ++k) {
      index_at_[Tile::place_of(tags[k])] = static_cast<std::uint32_t>(first + k) + 1;
    }
    last = tags.back();
  }
  index_at_[0] = 0;
  visible_.clear();
  for (std::uint32_t place = 1; place < index_at_.size(); ++place) {
    if (index_at_[place] == 0) continue;
    const std::uint32_t sample = index_at_[place] - 1;
    visible_.push_back(
        {tile.surfaces()[place].number(), Tile::column_of(sample), Tile::row_of(sample)});
    index_at_[place] = static_cast<std::uint32_t>(visible_.size());
  }
}

void TileSurfaces::find(const std::uint32_t* places, SurfaceIndices& indices) const {
  for (std::size_t k = 0; k < Tile::size; ++k) indices[k] = index_at_[places[k]];
}

TileSurfaces::Batch TileSurfaces::batch_from(std::size_t first, const ValueFrame& frame) const {
  Batch batch;
  const std::size_t most = std::min(TriangleLanes::most, visible_.size() - first);
  for (; batch.count < most; ++batch.count) {
    const auto& [number, column, row] = visible_[first + batch.count];
    const auto [origin, corners] = frame.rays.triangles().triangle(number);
    const triangle::ObjectRays* const object = &frame.rays.object(origin.object);
    if (!batch.object) batch.object = object;
    if (batch.object != object) break;
    for (std::size_t i = 0; i < 3; ++i) {
      batch.triangles.corners[i][0][batch.count] = corners[i].x;
      batch.triangles.corners[i][1][batch.count] = corners[i].y;
      batch.triangles.corners[i][2][batch.count] = corners[i].z;
    }
    batch.triangles.u[batch.count] = left_ + column;
    batch.triangles.v[batch.count] = top_ + row;
  }
  return batch;
}

void TileSurfaces::make_forms(const ValueFrame& frame) {
  constexpr LaneForm unknown{0, 0, 0, std::numeric_limits<double>::infinity()};
  for (std::vector<LaneForm>& forms : forms_) {
    forms.resize(visible_.size() + 1 + TriangleLanes::most);
    forms[0] = unknown;
  }
  for (std::size_t first = 0; first < visible_.size();) {
    const Batch batch = batch_from(first, frame);
    const LaneForms at{&forms_[0][first + 1], &forms_[1][first + 1], &forms_[2][first + 1]};
    if (batch.object->usable) {
      make_weight_forms(batch.triangles, *batch.object, frame.image, at);
    } else {
      for (std::vector<LaneForm>& forms : forms_) {
        std::fill_n(forms.begin() + static_cast<std::ptrdiff_t>(first) + 1, batch.count, unknown);
      }
    }
    first += batch.count;
  }
}

using namespace rendering;
using namespace triangle;

namespace {

/// Copies settled values of a row to its pixels, as far as they are wanted; returns the samples
/// that are left.
template <class T>
std::uint64_t copy(const VisibleRow& row, std::uint64_t wanted, const RoundedValues<T>& rounded,
                   T* target, RenderStatistics& statistics) {
  const std::uint64_t settled = wanted & rounded.settled;
  for (const std::size_t k : EachBit(settled)) target[row.first_pixel + k] = rounded.values[k];
  statistics.rounding.interval += static_cast<std::uint64_t>(std::popcount(settled));
  return wanted & ~settled;
}

/// Writes a whole row, with the background where there is no surface; returns the samples that are
/// left, which have the background, too.
template <class T>
std::uint64_t write_row(const MapRows& rows, const VisibleRow& row, RoundedValues<T>& rounded,
                        T background, T* target, RenderStatistics& statistics) {
  const std::uint64_t settled = row.surface & rounded.settled;
  for (const std::size_t k : EachBit(row.all() & ~settled)) rounded.values[k] = background;
  rows.write(rounded.values, row.columns, target + row.first_pixel);
  statistics.rounding.interval += static_cast<std::uint64_t>(std::popcount(settled));
  return row.surface & ~settled;
}

}  // namespace

CertifiedWriter::CertifiedWriter(ChannelWriter& exact, const SceneRays& rays, MapRows rows)
    : exact_(exact),
      values_(exact.values()),
      rows_(rows),
      frame_(rays),
      needs_wide_(values_.low || values_.depth.binary64 || values_.distance.binary64),
      needs_surfaces_(needs_wide_ || values_.shading_normal[0] || values_.barycentric[0] ||
                      values_.normal[0] || values_.camera_normal[0]),
      shading_normals_(exact.corner_normals()) {}

struct CertifiedWriter::Open {
  std::uint64_t depth = 0, distance = 0, low = 0, shading_normal = 0;
  std::array<std::uint64_t, 3> position{};
  std::array<std::uint64_t, 2> barycentric{};

  [[nodiscard]] std::uint64_t any() const {
    return depth | distance | low | shading_normal | position[0] | position[1] | position[2] |
           barycentric[0] | barycentric[1];
  }
};

void CertifiedWriter::start(const Tile& tile, const MapLayout& layout, Referee& referee,
                            RenderStatistics& statistics) {
  if (!needs_surfaces_) return;
  surfaces_.start(tile);
  if (values_.barycentric[0] || values_.shading_normal[0]) surfaces_.make_forms(frame_);
  if (needs_wide_) {
    wide_depths_.assign(1, unknown_wide_depth());
    for (const auto& surface : surfaces_.visible()) {
      wide_depths_.push_back(wide_depth(facts(surface.number), frame_));
    }
  }
  if (values_.shading_normal[0]) {
    corner_normals_.assign(1, lane_shading_normal(nullptr));
    for (const auto& surface : surfaces_.visible()) {
      SurfaceFacts& t = facts(surface.number);
      if (t.usable && !t.corner_normals) {
        t.corner_normals = shading_normals_.of_surface(surface.number, t);
      }
      corner_normals_.push_back(lane_shading_normal(t.usable ? &*t.corner_normals : nullptr));
    }
  }
  const WriterTarget target{values_, exact_, referee, statistics};
  const auto make = [&](bool in_camera_frame, auto normal, TileSurfaces::Normals& normals) {
    const std::size_t settled =
        surfaces_.make_normals(frame_, in_camera_frame, normals, [&](std::size_t index) {
          const auto& [number, column, row] = surfaces_.visible()[index - 1];
          const std::uint32_t x = tile.area().first_column + column;
          const std::uint32_t y = tile.area().first_row + row;
          const VisibleSurface surface{
              layout.pixel(x, y),
              number,
              {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}};
          const auto& n = (PixelWriter(surface, facts(number), frame_, target).*normal)();
          normals[index] = {n[0], n[1], n[2], 0};
        });
    statistics.rounding.interval += 3 * settled;
  };
  if (values_.normal[0]) make(false, &PixelWriter::normal, normals_);
  if (values_.camera_normal[0]) make(true, &PixelWriter::camera_normal, camera_normals_);
}

std::uint64_t CertifiedWriter::write_encoded(const VisibleRow& row, const EncodedValues& values,
                                             bool distance, RenderStatistics& statistics) const {
  if (values.codes) {
    RoundedValues<std::uint16_t> codes;
    round_to_codes(row.lanes, frame_.rays, distance, exact_.code_factor(), codes);
    return write_row(rows_, row, codes, std::uint16_t{0}, values.codes, statistics);
  }
  RoundedValues<float> rounded;
  round_depths(row.lanes, frame_.rays, distance, rounded);
  return write_row(rows_, row, rounded, Backgrounds::depth, values.binary32, statistics);
}

// In binary32 the remaining values are those that an interval did not settle (resolve()).
std::uint64_t CertifiedWriter::write_open_depths(const VisibleRow& row,
                                                 RenderStatistics& statistics) const {
  if (!values_.depth.wanted() || values_.depth.binary64 || row.open_depth == 0) return 0;
  if (!values_.depth.binary32) return write_encoded(row, values_.depth, false, statistics);
  RoundedValues<float> rounded;
  round_depths(row.lanes, frame_.rays, false, rounded);
  return copy(row, row.open_depth, rounded, values_.depth.binary32, statistics);
}

void CertifiedWriter::write_origins(const VisibleRow& row) const {
  if (values_.id) {
    MapRow<std::uint32_t> numbers;
    numbers.fill(no_surface);
    for (const std::size_t k : EachBit(row.surface)) {
      numbers[k] = static_cast<std::uint32_t>(row.lanes.tags[k]);
    }
    rows_.write(numbers, row.columns, values_.id + row.first_pixel);
  }
  if (!values_.wants_origins()) return;
  // face, object, and the segments.
  std::array<MapRow<std::uint32_t>, OriginNumbers::count> rows;
  for (MapRow<std::uint32_t>& numbers : rows) numbers.fill(no_surface);
  std::uint32_t last = no_surface;
  std::array<std::uint32_t, OriginNumbers::count> numbers{};
  for (const std::size_t k : EachBit(row.surface)) {
    const auto triangle = static_cast<std::uint32_t>(row.lanes.tags[k]);
    if (triangle != last) numbers = exact_.numbers_of(last = triangle).all();
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i][k] = numbers[i];
  }
  const auto targets = values_.origins();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (targets[i]) rows_.write(rows[i], row.columns, targets[i] + row.first_pixel);
  }
}

void CertifiedWriter::write_shading_normals(const VisibleRow& row, const SurfaceIndices& indices,
                                            Open& open, RenderStatistics& statistics) {
  std::array<RoundedValues<float>, 3> rounded;
  round_shading_normals(row.lanes, indices, surfaces_.forms(), corner_normals_.data(), rounded);
  for (std::size_t i = 0; i < 3; ++i) {
    open.shading_normal |= write_row(rows_, row, rounded[i], Backgrounds::other,
                                     values_.shading_normal[i], statistics);
  }
}

void CertifiedWriter::write_wide(const VisibleRow& row, const SurfaceIndices& indices, Open& open,
                                 RenderStatistics& statistics) const {
  RoundedValues<double> depth, distance;
  RoundedValues<float> low;
  round_wide(row.lanes, indices, wide_depths_.data(), frame_.rays,
             {values_.depth.binary64 ? &depth : nullptr,
              values_.distance.binary64 ? &distance : nullptr, values_.low ? &low : nullptr});
  const std::uint64_t before = statistics.rounding.interval;
  const double background = Backgrounds::depth;
  if (double* const target = values_.depth.binary64) {
    open.depth = write_row(rows_, row, depth, background, target, statistics);
  }
  if (double* const target = values_.distance.binary64) {
    open.distance = write_row(rows_, row, distance, background, target, statistics);
  }
  if (values_.low) {
    open.low = write_row(rows_, row, low, Backgrounds::other, values_.low, statistics);
  }
  statistics.double_word_roundings += statistics.rounding.interval - before;
}

void CertifiedWriter::write_normals(const VisibleRow& row, const SurfaceIndices& indices) const {
  std::array<MapRow<float>, 3> numbers;
  const auto write = [&](const TileSurfaces::Normals& normals,
                         const std::array<float*, 3>& values) {
    take_normals(indices, normals, numbers);
    for (std::size_t i = 0; i < 3; ++i) {
      rows_.write(numbers[i], row.columns, values[i] + row.first_pixel);
    }
  };
  if (values_.normal[0]) write(normals_, values_.normal);
  if (values_.camera_normal[0]) write(camera_normals_, values_.camera_normal);
}

CertifiedWriter::Open CertifiedWriter::write_settled(const VisibleRow& row,
                                                     RenderStatistics& statistics) {
  Open open;
  write_origins(row);
  open.depth = write_open_depths(row, statistics);
  if (values_.distance.wanted() && !values_.distance.binary64) {
    open.distance = write_encoded(row, values_.distance, true, statistics);
  }
  if (needs_surfaces_) {
    SurfaceIndices indices;
    surfaces_.find(row.lanes.places, indices);
    write_normals(row, indices);
    if (values_.shading_normal[0]) write_shading_normals(row, indices, open, statistics);
    if (needs_wide_) write_wide(row, indices, open, statistics);
    if (values_.barycentric[0]) {
      std::array<RoundedValues<float>, 2> rounded;
      round_weights(row.lanes, indices, surfaces_.forms(), rounded);
      for (std::size_t k = 0; k < 2; ++k) {
        open.barycentric[k] = write_row(rows_, row, rounded[k], Backgrounds::position,
                                        values_.barycentric[k], statistics);
      }
    }
  }
  if (!values_.position[0]) return open;
  std::array<RoundedValues<float>, 3> rounded;
  if (frame_.rays.world().usable) {
    round_positions(row.lanes, frame_.rays.world().rays, frame_.world_sizes,
                    frame_.image.perspective, rounded);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    open.position[k] =
        write_row(rows_, row, rounded[k], Backgrounds::position, values_.position[k], statistics);
  }
  return open;
}

std::optional<EncodingFault> CertifiedWriter::write(const VisibleRow& row, Referee& referee,
                                                    RenderStatistics& statistics) {
  const Open open = write_settled(row, statistics);
  const WriterTarget target{values_, exact_, referee, statistics};
  for (const std::size_t k : EachBit(open.any())) {
    const auto is_open = [&](std::uint64_t samples) { return (samples >> k & 1) != 0; };
    const VisibleSurface surface = row.at(k);
    PixelWriter pixel(surface, facts(surface.triangle), frame_, target);
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_open(open.position[i])) pixel.write_position(i);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (is_open(open.barycentric[i])) pixel.write_barycentric(i);
    }
    if (is_open(open.shading_normal)) pixel.write_shading_normal(shading_normals_);
    if (is_open(open.distance)) {
      if (auto fault = pixel.write_distance()) return fault;
    }
    if (is_open(open.low)) pixel.write_low_part();
    if (is_open(open.depth)) {
      if (auto fault = pixel.write_depth()) return fault;
    }
  }
  return std::nullopt;
}

}  // namespace fathom::fast
