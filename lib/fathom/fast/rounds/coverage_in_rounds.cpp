#include "fathom/fast/rounds/coverage_in_rounds.h"

#include <algorithm>
#include <utility>

#include "fathom/threads/threads.h"

namespace fathom::fast {
namespace {

/// The number of bins as for a scene in memory, and as for a round, so that their tables of tiles
/// stay small.
constexpr std::uint32_t parts_of_all = 64, parts_of_some = 8;

/// A bucket is for a row of tiles: few triangles meet more than one, and there are few buckets that
/// are written to in turn. It is for several rows, where an image is narrow, as work for threads.
std::uint32_t rows_of_bucket(const TileGrid& grid) {
  constexpr std::uint32_t least_tiles = 16;
  return (least_tiles - 1) / grid.columns + 1;
}

}  // namespace

CoverageInRounds::CoverageInRounds(const Scene& scene, std::vector<std::uint32_t> tiles,
                                   std::uint64_t most_bytes)
    : scene_(scene),
      coverage_frame_{scene.triangles, scene.frame.camera, scene.frame.options.cull},
      tiles_(std::move(tiles)),
      meetings_(tiles_.size()),
      most_bytes_(most_bytes),
      sorting_again_(
          [scene] { return FastWorker(scene.triangles, scene.frame.camera, scene.rays); }) {}

std::vector<CoverageInRounds::Tiles> CoverageInRounds::tiles_of_buckets() const {
  const TileGrid& grid = scene_.frame.grid;
  const std::uint32_t rows = rows_of_bucket(grid);
  std::vector<Tiles> buckets;
  for (std::uint32_t row = 0; row < grid.rows; row += rows) {
    const std::uint32_t end = std::min(grid.rows, row + rows);
    buckets.push_back(within(tiles_, row * grid.columns, end * grid.columns));
  }
  return buckets;
}

CoverageInRounds::Tiles CoverageInRounds::within(Tiles tiles, std::uint32_t first,
                                                 std::uint32_t end) {
  const auto from = std::ranges::lower_bound(tiles, first);
  return {from, std::lower_bound(from, tiles.end(), end)};
}

void CoverageInRounds::give_up_from(std::uint32_t tile) {
  const auto end = std::lower_bound(tiles_.begin(), tiles_.end(), tile);
  tiles_.erase(end, tiles_.end());
}

void CoverageInRounds::count_meetings(const std::vector<Bins>& bins) {
  for (const Bins& some : bins) {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      meetings_[i] += some.in_tile(tiles_[i], Side::front).size();
      meetings_[i] += some.in_tile(tiles_[i], Side::back).size();
    }
  }
}

void CoverageInRounds::add(const ImageObjects& objects, const std::vector<Bins>& bins) {
  count_meetings(bins);
  if (spilled_) {
    spill(objects, bins, tiles_of_buckets(), *spilled_);
    return;
  }
  keep(objects, bins);
  if (kept_size_.bytes_in_use() > most_bytes_) begin_to_spill();
}

void CoverageInRounds::keep(const ImageObjects& objects, const std::vector<Bins>& bins) {
  std::vector<std::vector<KeptTriangles>> parts(bins.size());
  parallel_for(std::size_t{0}, bins.size(), [&](std::size_t i) {
    parts[i] = triangles_in_tiles(objects, {&bins[i], 1}, tiles_, scene_.triangles);
  });
  for (std::vector<KeptTriangles>& part : parts) {
    for (KeptTriangles& some : part) {
      kept_size_ += size_of(some);
      kept_.push_back(std::move(some));
    }
  }
}

void CoverageInRounds::begin_to_spill() {
  const std::vector<Tiles> buckets = tiles_of_buckets();
  spilled_.emplace(buckets.size());
  for (KeptTriangles& some : kept_) spill(std::exchange(some, {}), buckets, *spilled_);
  kept_ = std::vector<KeptTriangles>();  // {} would keep its memory
}

void CoverageInRounds::spill(const ImageObjects& objects, const std::vector<Bins>& bins,
                             std::span<const Tiles> runs, SpilledTriangles& to) const {
  parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) {
    to.add(i, triangles_in_tiles(objects, bins, runs[i], scene_.triangles));
  });
}

void CoverageInRounds::spill(const KeptTriangles& kept, std::span<const Tiles> runs,
                             SpilledTriangles& to) {
  GatheredTriangles round;
  round.add(kept);
  round.sort(parts_of_some, scene_.triangles, scene_.frame, sorting_again_);
  spill(round.objects(), round.bins(), runs, to);
}

void CoverageInRounds::write(std::uint32_t first, std::uint32_t end, const WriteTile& write) {
  if (!spilled_) {
    sort_kept();
    write_tiles(*all_, within(tiles_, first, end), write);
    return;
  }
  const std::vector<Tiles> buckets = tiles_of_buckets();
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const Tiles tiles = within(buckets[i], first, end);
    if (tiles.size() == buckets[i].size()) {
      write_bucket(*spilled_, i, tiles, write);
    } else if (!tiles.empty()) {
      SpilledTriangles part(1);
      spilled_->for_each(i, [&](const KeptTriangles& kept) { spill(kept, {&tiles, 1}, part); });
      write_bucket(part, 0, tiles, write);
    }
  }
}

void CoverageInRounds::sort_kept() {
  if (all_) return;
  all_.emplace();
  all_->take(kept_);
  all_->sort(parts_of_all, scene_.triangles, scene_.frame, sorting_again_);
}

// A bucket that is too large is read one more time than others, whatever its size.
void CoverageInRounds::write_bucket(const SpilledTriangles& spilled, std::size_t bucket,
                                    Tiles tiles, const WriteTile& write) {
  const KeptSize size = spilled.size_of_bucket(bucket);
  if (size.is_nothing()) return;
  const std::vector<Tiles> runs = runs_that_fit(tiles, size);
  if (runs.size() > 1) {
    SpilledTriangles parts(runs.size());
    spilled.for_each(bucket, [&](const KeptTriangles& kept) { spill(kept, runs, parts); });
    for (std::size_t i = 0; i < runs.size(); ++i) write_bucket(parts, i, runs[i], write);
    return;
  }
  GatheredTriangles gathered;
  spilled.gather(bucket, gathered);
  gathered.sort(parts_of_some, scene_.triangles, scene_.frame, sorting_again_);
  write_tiles(gathered, tiles, write);
}

// Triangles that meet several of the tiles are counted for each.
std::vector<CoverageInRounds::Tiles> CoverageInRounds::runs_that_fit(Tiles tiles,
                                                                     const KeptSize& bucket) const {
  const std::uint64_t bytes = bucket.bytes_in_use();
  if (bytes <= most_bytes_) return {tiles};
  const double per_triangle = static_cast<double>(bytes) / static_cast<double>(bucket.triangles);
  const std::uint64_t* const meetings = meetings_.data() + (tiles.data() - tiles_.data());
  std::vector<Tiles> runs;
  double needed = 0;
  for (std::size_t i = 0, first = 0; i < tiles.size(); ++i) {
    const double more = per_triangle * static_cast<double>(meetings[i]);
    if (i > first && needed + more > static_cast<double>(most_bytes_)) {
      runs.push_back(tiles.subspan(first, i - first));
      first = i;
      needed = 0;
    }
    needed += more;
    if (i + 1 == tiles.size()) runs.push_back(tiles.subspan(first));
  }
  return runs;
}

void CoverageInRounds::write_tiles(const GatheredTriangles& gathered, Tiles tiles,
                                   const WriteTile& write) const {
  PerThread<TileCoverage> coverages([&] {
    return TileCoverage({coverage_frame_, gathered.objects(), gathered.bins(), MapRows{}});
  });
  const auto first = static_cast<std::size_t>(tiles.data() - tiles_.data());
  parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    if (meetings_[first + i] != 0) write(tiles[i], coverages.local());
  });
}

}  // namespace fathom::fast
