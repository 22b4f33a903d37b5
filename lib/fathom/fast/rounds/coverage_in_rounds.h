#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/coverage/tile_coverage.h"
#include "fathom/fast/rounds/kept_triangles.h"
#include "fathom/fast/tiles/frame.h"

namespace fathom::fast {

/// Channel A where triangles are sorted into tiles in rounds and do not stay in memory. What meets
/// a tile must be together when its pixels are settled, so this keeps the triangles that any tile
/// needs: in memory as long as they fit, and from then on in a file without a name, in buckets for
/// runs of tiles that come after each other. At the end each bucket is read and sorted into tiles
/// again, and TileCoverage says the same of them as of a scene in memory.
///
/// Memory   about `most_bytes`, 8 bytes per tile, and 24 for each round and each bucket that it has
///          triangles for. A bucket that needs more is cut into smaller ones first. All triangles
///          that meet one tile are in memory together, whatever they take: about 1000 bytes each.
/// Disk     about 28 bytes for each triangle and bucket; 88 where vertices are not shared.
class CoverageInRounds {
 public:
  /// What is rendered: views, all of which outlive it. `frame.by_area` is set.
  struct Scene {
    const FastFrame& frame;
    const TriangleSource& triangles;
    const triangle::SceneRays& rays;
  };
  /// `tiles`: the numbers of those whose values are wanted, in ascending order.
  CoverageInRounds(const Scene& scene, std::vector<std::uint32_t> tiles, std::uint64_t most_bytes);

  /// Takes what meets the tiles out of a round: objects whose triangles are numbered as in the
  /// scene, or have scene_numbers, and all bins that they were sorted into. No triangle comes
  /// twice.
  /// Fails    OutputError: the folder for temporary files is full, or cannot be written to.
  void add(const ImageObjects& objects, const std::vector<Bins>& bins);
  /// Tiles of this number and above are not wanted any more.
  void give_up_from(std::uint32_t tile);

  /// Writes a tile's values by coverage.write(), for which it has been drawn.
  using WriteTile = std::function<void(std::uint32_t tile, TileCoverage& coverage)>;
  /// Calls write(tile, coverage) for the tiles first ≤ tile < end that triangles meet, several at
  /// the same time; in the others A is 0. After the last round, for each tile once.
  void write(std::uint32_t first, std::uint32_t end, const WriteTile& write);

 private:
  using Tiles = std::span<const std::uint32_t>;
  /// The tiles that are still wanted, by buckets.
  [[nodiscard]] std::vector<Tiles> tiles_of_buckets() const;
  /// Of some, those from first to end.
  [[nodiscard]] static Tiles within(Tiles tiles, std::uint32_t first, std::uint32_t end);
  void count_meetings(const std::vector<Bins>& bins);
  /// Takes the triangles of a round into memory.
  void keep(const ImageObjects& objects, const std::vector<Bins>& bins);
  /// From now on, triangles are in the file.
  void begin_to_spill();
  /// Adds what meets tiles to a bucket for each of these runs.
  void spill(const ImageObjects& objects, const std::vector<Bins>& bins,
             std::span<const Tiles> runs, SpilledTriangles& to) const;
  /// The same, once it has been sorted.
  void spill(const KeptTriangles& kept, std::span<const Tiles> runs, SpilledTriangles& to);

  void write_bucket(const SpilledTriangles& spilled, std::size_t bucket, Tiles tiles,
                    const WriteTile& write);
  /// Cuts the tiles of a bucket into runs of which each is little enough for the memory, or one
  /// tile.
  [[nodiscard]] std::vector<Tiles> runs_that_fit(Tiles tiles, const KeptSize& bucket) const;
  void sort_kept();
  void write_tiles(const GatheredTriangles& gathered, Tiles tiles, const WriteTile& write) const;

  Scene scene_;
  CoverageFrame coverage_frame_;
  std::vector<std::uint32_t> tiles_;
  /// For each of them, how many triangles meet it.
  std::vector<std::uint64_t> meetings_;
  std::uint64_t most_bytes_;
  /// What is in memory.
  std::vector<KeptTriangles> kept_;
  KeptSize kept_size_;
  /// The same, sorted into tiles when the first of them is written.
  std::optional<GatheredTriangles> all_;
  std::optional<SpilledTriangles> spilled_;
  /// Their statistics would count triangles again.
  FastWorkers sorting_again_;
};

}  // namespace fathom::fast
