#pragma once

#include <mutex>
#include <optional>
#include <utility>

#include "fathom/fast/channels/certified_writer.h"
#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/threads/per_thread.h"
#include "fathom/triangle/channels.h"

namespace fathom::fast {

/// Where a tile is written to.
struct TileOutput {
  CertifiedWriter& certified;
  /// If not null, the values of channel Z, which are written for the whole area.
  float* depths;
  /// Whether there are channels other than Z in binary32 and A, and their background, if they must
  /// be filled.
  bool others;
  const BackgroundRows& background;
  MapLayout layout;
};

/// Writes the visible surfaces; stops at the first fault in row order, whose pixel is numbered in
/// the map.
std::optional<triangle::EncodingFault> resolve(const Tile& tile, const TileOutput& output,
                                               const DrawContext& context);

/// The fault of the first pixel in row order, over all tiles.
class FirstFault {
 public:
  void add(std::optional<triangle::EncodingFault> fault) {
    if (!fault) return;
    const std::lock_guard lock(mutex_);
    if (!first_ || fault->pixel < first_->pixel) first_ = std::move(fault);
  }
  [[nodiscard]] const std::optional<triangle::EncodingFault>& get() const { return first_; }

 private:
  std::optional<triangle::EncodingFault> first_;
  std::mutex mutex_;
};

/// Where the tiles write, from any thread.
class FastOutput {
 public:
  /// `unfilled`: of the channels that have not been filled with it. A is written elsewhere.
  FastOutput(DepthMap& map, triangle::ChannelWriter& writer, const triangle::SceneRays& rays,
             rendering::MapBackground unfilled = {}, MapRows rows = {});
  /// For a tile without any triangle: all channels.
  void write_background(const PixelBox& area, const MapLayout& layout) const;
  std::optional<triangle::EncodingFault> write(const Tile& tile, const MapLayout& layout,
                                               const DrawContext& context) {
    return resolve(tile, {certified_.local(), depths_, others_, beside_surfaces_, layout}, context);
  }

 private:
  MapRows rows_;
  PerThread<CertifiedWriter> certified_;
  /// The values of Z in binary32.
  float* depths_;
  /// Whether there are channels besides these and A.
  bool others_;
  /// The background of all channels, and of all channels except A and these.
  BackgroundRows all_, beside_surfaces_;
};

}  // namespace fathom::fast
