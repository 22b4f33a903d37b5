#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/channels/channel_rows.h"
#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/channels/surface_lanes.h"
#include "fathom/fast/channels/wide_rows.h"
#include "fathom/fast/pixels/pixel_writer.h"
#include "fathom/fast/pixels/surface_values.h"
#include "fathom/rendering/rendered.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/rays.h"
#include "fathom/triangle/recent_triangles.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

class Tile;

/// The visible surfaces of a tile and the properties that channels need, computed for several
/// surfaces at once. One for each thread.
class TileSurfaces {
 public:
  /// A surface, and one of the samples that show it, by its column and row in the tile.
  struct Visible {
    std::uint32_t number, column, row;
  };

  /// Finds the surfaces of a tile.
  void start(const Tile& tile);
  /// In the order of their indices, 1, 2, …; index 0 means no surface.
  [[nodiscard]] std::span<const Visible> visible() const { return visible_; }
  /// The indices of the surfaces that have these places in the tile.
  void find(const std::uint32_t* places, SurfaceIndices& indices) const;

  /// Computes the forms of weights, by index; the forms of index 0 are unknown.
  void make_forms(const ValueFrame& frame);
  [[nodiscard]] LaneForms forms() { return {forms_[0].data(), forms_[1].data(), forms_[2].data()}; }
  /// Normals by index; index 0 is no surface. Calls settle(index) to write a normal that is not
  /// settled here. Returns the number of normals that are settled here.
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
  /// The index of each place; during the search, a sample that shows it, plus 1.
  std::vector<std::uint32_t> index_at_;
  std::array<std::vector<LaneForm>, 3> forms_;
};

/// A row of a tile, with the surfaces that are visible in it.
struct VisibleRow {
  SurfaceRow lanes;
  /// A bit for each sample that shows a surface.
  std::uint64_t surface = 0;
  /// A bit for each of these samples at which Z is still to be written.
  std::uint64_t open_depth = 0;
  std::size_t first_pixel = 0;  // of the first sample (MapLayout)
  std::size_t columns = TileShape::size;

  [[nodiscard]] std::uint64_t all() const {
    return ~std::uint64_t{0} >> (TileShape::size - columns);
  }

  [[nodiscard]] VisibleSurface at(std::size_t k) const {
    return {first_pixel + k,
            static_cast<std::uint32_t>(lanes.tags[k]),
            {lanes.first_u + static_cast<double>(k), lanes.v}};
  }
};

/// Writes every channel of the specification, section 6, by certified floating point: a value has a
/// proved bound on its error, and is written if all numbers within the bound round to the same
/// result. Tiers, each tried where the previous tier does not settle a value:
///   binary64      from the tile's q (Z, distance, P) or from the triangle (N, Nc, Ns, bary);
///   double-words  from the triangle, not Ns; Zlow and binary64 output begin here;
///   constants     depth or a world coordinate is exactly the same at the three corners, or a
///                 value is proved to be exactly 0, or a depth to be a binary32 number, because
///                 its numerator is a multiple of a power of two above its bound;
///   exact         ChannelWriter, that value alone.
/// One for each thread, because it caches the triangles that it used last.
class CertifiedWriter {
 public:
  CertifiedWriter(triangle::ChannelWriter& exact, const triangle::SceneRays& rays, MapRows rows);
  [[nodiscard]] const MapRows& rows() const { return rows_; }

  /// Call it before writing the rows of a tile.
  void start(const Tile& tile, const MapLayout& layout, triangle::Referee& referee,
             RenderStatistics& statistics);
  /// If the encoding cannot hold a depth, returns the fault of the first such pixel.
  /// `statistics.rounding` counts values.
  std::optional<triangle::EncodingFault> write(const VisibleRow& row, triangle::Referee& referee,
                                               RenderStatistics& statistics);

 private:
  /// The samples of a row at which channels are still to be written.
  struct Open;

  /// Writes id, face, object and the segments.
  void write_origins(const VisibleRow& row) const;
  /// Writes the channels that are the same at all pixels of a triangle.
  void write_normals(const VisibleRow& row, const SurfaceIndices& indices) const;
  /// Writes the channels that follow from number and q; returns the samples that remain.
  Open write_settled(const VisibleRow& row, RenderStatistics& statistics);
  std::uint64_t write_encoded(const VisibleRow& row, const rendering::EncodedValues& values,
                              bool distance, RenderStatistics& statistics) const;
  std::uint64_t write_open_depths(const VisibleRow& row, RenderStatistics& statistics) const;
  void write_shading_normals(const VisibleRow& row, const SurfaceIndices& indices, Open& open,
                             RenderStatistics& statistics);
  /// Writes the channels that binary64 never settles.
  void write_wide(const VisibleRow& row, const SurfaceIndices& indices, Open& open,
                  RenderStatistics& statistics) const;

  SurfaceFacts& facts(std::uint32_t number) {
    return remembered_.get(number, [&](SurfaceFacts& t) { t = surface_facts(number, frame_); });
  }

  triangle::ChannelWriter& exact_;
  const rendering::ChannelValues values_;
  const MapRows rows_;
  const ValueFrame frame_;
  /// Whether a requested channel begins with double-words: Zlow, or depth or distance in binary64.
  bool needs_wide_;
  /// Whether a requested channel needs the surfaces of the tile.
  bool needs_surfaces_;
  TileSurfaces surfaces_;
  /// By the surfaces' indices.
  TileSurfaces::Normals normals_, camera_normals_;
  std::vector<WideDepth> wide_depths_;
  std::vector<LaneShadingNormal> corner_normals_;
  triangle::RecentTriangles<SurfaceFacts, 512> remembered_;
  ShadingNormals shading_normals_;
};

}  // namespace fathom::fast
