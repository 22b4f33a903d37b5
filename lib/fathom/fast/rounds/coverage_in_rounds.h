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

/// Channel A where triangles are sorted into tiles in rounds and do not stay in memory. All
/// triangles that meet a tile must be available together when its pixels are settled. This class
/// therefore keeps the triangles that any tile needs: in memory while they fit, afterwards in an
/// unnamed file, in one bucket for each run of consecutive tiles. At the end each bucket is read
/// and sorted into tiles again, and TileCoverage computes the same values as for a scene in memory.
///
/// Memory   about `most_bytes`, 8 bytes per tile, and 24 bytes for each round and each bucket that
///          receives triangles in it. A bucket that needs more than `most_bytes` is divided into
///          smaller buckets first. All triangles that meet one tile are in memory together, without
///          a limit: about 1000 bytes each.
/// Disk     about 28 bytes for each triangle and bucket; 88 where vertices are not shared.
class CoverageInRounds {
 public:
  /// References to the rendered scene; their targets must outlive the object. `frame.by_area` is
  /// set.
  struct Scene {
    const FastFrame& frame;
    const TriangleSource& triangles;
    const triangle::SceneRays& rays;
  };
  /// `tiles`: the numbers of the wanted tiles, in ascending order.
  CoverageInRounds(const Scene& scene, std::vector<std::uint32_t> tiles, std::uint64_t most_bytes);

  /// Takes the triangles of a round that meet the tiles: objects whose triangles are numbered as in
  /// the scene, or have scene_numbers, and all bins that they were sorted into. No triangle may
  /// come twice.
  /// Fails    OutputError: the folder for temporary files is full, or cannot be written to.
  void add(const ImageObjects& objects, const std::vector<Bins>& bins);
  /// Gives up the tiles of this number and above.
  void give_up_from(std::uint32_t tile);

  /// Writes a tile's values by coverage.write(), for which it has been drawn.
  using WriteTile = std::function<void(std::uint32_t tile, TileCoverage& coverage)>;
  /// Calls write(tile, coverage) for the tiles first ≤ tile < end that triangles meet, in several
  /// threads; in other tiles A is 0. Call it after the last round, once for each tile.
  void write(std::uint32_t first, std::uint32_t end, const WriteTile& write);

 private:
  using Tiles = std::span<const std::uint32_t>;
  /// The tiles that are still wanted, by buckets.
  [[nodiscard]] std::vector<Tiles> tiles_of_buckets() const;
  /// The tiles from `first` to `end` among some tiles.
  [[nodiscard]] static Tiles within(Tiles tiles, std::uint32_t first, std::uint32_t end);
  void count_meetings(const std::vector<Bins>& bins);
  /// Takes the triangles of a round into memory.
  void keep(const ImageObjects& objects, const std::vector<Bins>& bins);
  /// From now on, triangles are in the file.
  void begin_to_spill();
  /// Adds the triangles that meet each of these runs of tiles to the bucket of the run.
  void spill(const ImageObjects& objects, const std::vector<Bins>& bins,
             std::span<const Tiles> runs, SpilledTriangles& to) const;
  /// The same, once it has been sorted.
  void spill(const KeptTriangles& kept, std::span<const Tiles> runs, SpilledTriangles& to);

  void write_bucket(const SpilledTriangles& spilled, std::size_t bucket, Tiles tiles,
                    const WriteTile& write);
  /// Divides the tiles of a bucket into runs whose triangles fit into the memory; a run may be a
  /// single tile that does not fit.
  [[nodiscard]] std::vector<Tiles> runs_that_fit(Tiles tiles, const KeptSize& bucket) const;
  void sort_kept();
  void write_tiles(const GatheredTriangles& gathered, Tiles tiles, const WriteTile& write) const;

  Scene scene_;
  CoverageFrame coverage_frame_;
  std::vector<std::uint32_t> tiles_;
  /// For each tile, the number of triangles that meet it.
  std::vector<std::uint64_t> meetings_;
  std::uint64_t most_bytes_;
  /// The triangles in memory.
  std::vector<KeptTriangles> kept_;
  KeptSize kept_size_;
  /// The same, sorted into tiles when the first of them is written.
  std::optional<GatheredTriangles> all_;
  std::optional<SpilledTriangles> spilled_;
  /// Separate workers, so that their statistics do not count triangles twice.
  FastWorkers sorting_again_;
};

}  // namespace fathom::fast
