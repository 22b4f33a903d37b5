#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/channels/surface_lanes.h"

namespace fathom::fast {

class Tile;

/// The surfaces that are visible in a tile, and what channels need to know of each of them,
/// computed for several at once. One for each thread.
class TileSurfaces {
 public:
  /// A surface, and one of the samples that show it, by its column and row in the tile.
  struct Visible {
    std::uint32_t number, column, row;
  };

  /// Finds the surfaces of a tile.
  void start(const Tile& tile);
  /// In the order of their indices, which are 1, 2, …; 0 is that of no surface.
  [[nodiscard]] std::span<const Visible> visible() const { return visible_; }
  /// The indices of the surfaces that have these places in the tile.
  void find(const std::uint32_t* places, SurfaceIndices& indices) const;

  /// Forms of weights, by index; nothing is known of those of no surface.
  void make_forms(const ValueFrame& frame);
  [[nodiscard]] LaneForms forms() { return {forms_[0].data(), forms_[1].data(), forms_[2].data()}; }
  /// Normals by index, 0 of no surface. settle(index): writes one that is not settled here.
  /// Returns how many are.
  using Normals = std::vector<NormalOfSurface>;
  template <class Settle>
  std::size_t make_normals(const ValueFrame& frame, bool in_camera_frame, Normals& normals,
                           const Settle& settle) const {
    std::size_t settled_here = 0;
    normals.resize(visible_.size() + 1 + TriangleLanes::most);
    normals[0] = {};
    for (std::size_t first = 0; first < visible_.size();) {
      const Batch batch = batch_from(first, frame);
      const auto& object = *batch.object;
      const bool usable = object.usable && frame.rays.world().usable &&
                          (!in_camera_frame || object.camera_normals_usable);
      const unsigned settled = usable ? round_normals(batch.triangles, object, frame,
                                                      in_camera_frame, normals.data() + first + 1)
                                      : 0;
      for (std::size_t k = 0; k < batch.count; ++k) {
        if (settled >> k & 1) {
          ++settled_here;
        } else {
          settle(first + k + 1);
        }
      }
      first += batch.count;
    }
    return settled_here;
  }

 private:
  /// Consecutive surfaces of one object.
  struct Batch {
    TriangleLanes triangles;
    const triangle::ObjectRays* object = nullptr;
    std::size_t count = 0;
  };
  [[nodiscard]] Batch batch_from(std::size_t first, const ValueFrame& frame) const;

  double left_ = 0, top_ = 0;
  std::vector<Visible> visible_;
  /// By place; and, while surfaces are looked for, one of the samples that show it, and 1.
  std::vector<std::uint32_t> index_at_;
  std::array<std::vector<LaneForm>, 3> forms_;
};

}  // namespace fathom::fast
