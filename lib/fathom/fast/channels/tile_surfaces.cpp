#include "fathom/fast/channels/tile_surfaces.h"

#include <algorithm>
#include <limits>

#include "fathom/fast/tiles/tile.h"

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

}  // namespace fathom::fast
