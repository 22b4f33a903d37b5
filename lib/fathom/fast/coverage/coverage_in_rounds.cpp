#include "fathom/fast/coverage/coverage_in_rounds.h"

#include <algorithm>
#include <utility>

#include "fathom/threads/threads.h"

namespace fathom::fast {
namespace {

/// As many bins as a scene in memory has; as a round has, so that their tables of tiles stay small.
constexpr std::uint32_t parts_of_all = 64, parts_of_some = 8;

/// A bucket is for a row of tiles: few triangles meet more than one, and there are few buckets that
/// are written to in turn. It has at least so many, where an image is narrow, as work for threads.
constexpr std::uint32_t least_tiles = 16;

}  // namespace

CoverageInRounds::CoverageInRounds(const Scene& scene, std::vector<std::uint32_t> tiles,
                                   std::uint64_t most_bytes)
    : scene_(scene),
      coverage_frame_{scene.triangles, scene.frame.camera, scene.frame.options.cull},
      tiles_(std::move(tiles)),
      meetings_(tiles_.size()),
      most_bytes_(most_bytes),
      tiles_of_bucket_(std::max(scene.frame.grid.columns, least_tiles)),
      sorting_again_(
          [scene] { return FastWorker(scene.triangles, scene.frame.camera, scene.rays); }) {}

std::size_t CoverageInRounds::bucket_count() const {
  return (tiles_.size() + tiles_of_bucket_ - 1) / tiles_of_bucket_;
}

CoverageInRounds::Tiles CoverageInRounds::tiles_of(std::size_t bucket) const {
  const Tiles from = Tiles(tiles_).subspan(bucket * tiles_of_bucket_);
  return from.first(std::min(from.size(), tiles_of_bucket_));
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
    spill(objects, bins);
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
  spilled_.emplace(bucket_count());
  for (KeptTriangles& some : kept_) {
    GatheredTriangles round;
    round.add(std::exchange(some, {}));
    sort(round, parts_of_some);
    spill(round.objects(), round.bins());
  }
  kept_ = {};
}

void CoverageInRounds::spill(const ImageObjects& objects, const std::vector<Bins>& bins) {
  parallel_for(std::size_t{0}, bucket_count(), [&](std::size_t bucket) {
    spilled_->add(bucket, triangles_in_tiles(objects, bins, tiles_of(bucket), scene_.triangles));
  });
}

void CoverageInRounds::sort(GatheredTriangles& gathered, std::uint32_t parts) {
  gathered.sort(parts, scene_.triangles, scene_.frame, sorting_again_);
}

CoverageInRounds::Tiles CoverageInRounds::within(Tiles tiles, std::uint32_t first,
                                                 std::uint32_t end) {
  const auto from = std::ranges::lower_bound(tiles, first);
  return {from, std::lower_bound(from, tiles.end(), end)};
}

void CoverageInRounds::write(std::uint32_t first, std::uint32_t end, const WriteTile& write) {
  if (spilled_) {
    for (std::size_t bucket = 0; bucket < bucket_count(); ++bucket)
      write_bucket(bucket, first, end, write);
    return;
  }
  if (!all_) {
    all_.emplace();
    all_->take(kept_);
    sort(*all_, parts_of_all);
  }
  write_tiles(*all_, within(tiles_, first, end), write);
}

void CoverageInRounds::write_bucket(std::size_t bucket, std::uint32_t first, std::uint32_t end,
                                    const WriteTile& write) {
  const KeptSize size = spilled_->size_of_bucket(bucket);
  if (size.is_nothing()) return;
  for (Tiles left = within(tiles_of(bucket), first, end); !left.empty();) {
    const Tiles some = first_that_fit(left, size);
    GatheredTriangles gathered;
    if (some.size() == tiles_of(bucket).size()) {
      spilled_->gather(bucket, gathered);
    } else {
      gather_some(bucket, some, gathered);
    }
    sort(gathered, parts_of_some);
    write_tiles(gathered, some, write);
    left = left.subspan(some.size());
  }
}

// Triangles that meet several of the tiles are counted for each.
CoverageInRounds::Tiles CoverageInRounds::first_that_fit(Tiles tiles,
                                                         const KeptSize& bucket) const {
  const std::uint64_t bytes = bucket.bytes_in_use();
  if (bytes <= most_bytes_) return tiles;
  const double per_triangle = static_cast<double>(bytes) / static_cast<double>(bucket.triangles);
  const std::uint64_t* const meetings = meetings_.data() + (tiles.data() - tiles_.data());
  std::size_t count = 0;
  for (double needed = 0; count < tiles.size(); ++count) {
    needed += per_triangle * static_cast<double>(meetings[count]);
    if (count > 0 && needed > static_cast<double>(most_bytes_)) break;
  }
  return tiles.first(count);
}

void CoverageInRounds::gather_some(std::size_t bucket, Tiles tiles, GatheredTriangles& to) {
  spilled_->for_each(bucket, [&](const KeptTriangles& block) {
    GatheredTriangles round;
    round.add(block);
    sort(round, parts_of_some);
    for (const KeptTriangles& some :
         triangles_in_tiles(round.objects(), round.bins(), tiles, scene_.triangles)) {
      to.add(some);
    }
  });
}

void CoverageInRounds::write_tiles(const GatheredTriangles& gathered, Tiles tiles,
                                   const WriteTile& write) const {
  PerThread<TileCoverage> coverages([&] {
    return TileCoverage({coverage_frame_, gathered.objects(), gathered.bins(), MapRows{}});
  });
  const std::size_t first = static_cast<std::size_t>(tiles.data() - tiles_.data());
  parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    if (meetings_[first + i] != 0) write(tiles[i], coverages.local());
  });
}

}  // namespace fathom::fast
