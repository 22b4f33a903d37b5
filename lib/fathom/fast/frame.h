#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "fathom/fast/background_rows.h"
#include "fathom/fast/bins.h"
#include "fathom/fast/certified_writer.h"
#include "fathom/fast/tile.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

/// What the fast engine works with, whether its scene is in memory or in files.
namespace fathom::fast {

/// What a thread works with.
struct FastWorker {
  FastWorker(const TriangleSource& triangles, const Camera& camera, const triangle::SceneRays& rays)
      : referee(triangles, camera, &rays),
        exact_setups({0, camera.width - 1, 0, camera.height - 1}) {}
  triangle::Referee referee;
  ExactSetups exact_setups;
  RenderStatistics statistics;
  std::vector<DoubtfulPixel> doubtful;
};
using FastWorkers = PerThread<FastWorker>;

/// The sum of the statistics of all threads.
RenderStatistics sum_of(const FastWorkers& workers, std::uint64_t triangles);

/// Collects the doubtful pixels of all threads, if they were asked for.
void collect_doubtful(const FastWorkers& workers, const Camera& camera,
                      const RenderOptions& options);

/// What all threads share.
struct FastFrame {
  FastFrame(const Camera& camera, const RenderOptions& options);

  [[nodiscard]] Tile::Context context(FastWorker& worker) const {
    return {worker.referee,
            worker.statistics,
            range,
            perspective,
            options.fast,
            options.fast.doubtful ? &worker.doubtful : nullptr,
            worker.exact_setups,
            by_area};
  }

  const Camera& camera;
  const RenderOptions& options;
  TileGrid grid;
  DepthRange range;
  bool perspective;
  /// Whether tiles get all triangles that meet them, for channel A.
  bool by_area;
};

/// Sorts triangles [first, end) of the scene, all of which belong to these objects, into tiles:
/// `parts` bins of equal length, or fewer, so that each thread has several and their tables of
/// tiles stay small.
/// `bins` lend their memory, and keep it if the options say so.
std::vector<Bins> sort_into_tiles(const ImageObjects& objects, std::uint32_t first,
                                  std::uint32_t end, std::uint32_t parts, const FastFrame& frame,
                                  FastWorkers& workers, std::vector<Bins> bins = {});

/// Draws the triangles of a tile.
void draw_tile(Tile& tile, std::uint32_t number, const std::vector<Bins>& all_bins,
               const ImageObjects& objects, const Tile::Context& context);

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
             triangle::MapBackground unfilled = {}, MapRows rows = {});
  /// For a tile without any triangle: all channels.
  void write_background(const PixelBox& area, const MapLayout& layout) const;
  std::optional<triangle::EncodingFault> write(const Tile& tile, const MapLayout& layout,
                                               const Tile::Context& context) {
    return tile.resolve({certified_.local(), depths_, others_, beside_surfaces_, layout}, context);
  }

 private:
  MapRows rows_;
  PerThread<CertifiedWriter> certified_;
  /// The values of Z in binary32.
  float* depths_;
  /// Whether there are channels besides these and A.
  bool others_;
  /// Of all channels, and of those besides A and these.
  BackgroundRows all_, beside_surfaces_;
};

}  // namespace fathom::fast
