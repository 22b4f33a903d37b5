#include "fathom/reference/pixel_hits.h"

#include <algorithm>
#include <numeric>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom {
using namespace triangle;

namespace {

/// A hit, before hits are sorted by pixels.
struct PlacedHit {
  std::size_t pixel;
  PixelHit hit;
};

class HitFinder {
 public:
  HitFinder(const Scene& scene, const Camera& camera, Cull cull)
      : triangles_(scene), camera_(camera), cull_(cull) {}

  [[nodiscard]] std::uint64_t triangle_count() const { return triangles_.count(); }

  void append_hits(std::uint32_t number, std::vector<PlacedHit>& found) const {
    const ProjectedTriangle t = projected(number);
    if (t.orientation == Sign::zero || !is_kept(t, cull_)) return;
    const PixelBox box = bounding_box(t, camera_);
    if (box.is_empty()) return;
    TierCounts counts;
    for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
      for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
        const ImagePoint s = centre_of_pixel(column, row);
        if (!covers(t, s, counts)) continue;
        const Ratio depth = depth_at(t, s);
        if (!is_in_range(depth, camera_)) continue;
        found.push_back({pixel_at(column, row), {number, round_to_binary64(depth)}});
      }
    }
  }

  /// Sorts the hits of a pixel. Rounding keeps the order, so only equal depths are computed again.
  void sort(std::size_t pixel, PixelHit* first, PixelHit* last) const {
    const ImagePoint s = centre_of_pixel(static_cast<std::uint32_t>(pixel % camera_.width),
                                         static_cast<std::uint32_t>(pixel / camera_.width));
    std::sort(first, last, [&](const PixelHit& a, const PixelHit& b) {
      if (a.depth != b.depth) return a.depth < b.depth;
      if (a.triangle == b.triangle) return false;
      const Ratio of_a = depth_at(projected(a.triangle), s);
      const Ratio of_b = depth_at(projected(b.triangle), s);
      return of_a == of_b ? a.triangle < b.triangle : of_a < of_b;
    });
  }

 private:
  [[nodiscard]] ProjectedTriangle projected(std::uint32_t number) const {
    TierCounts counts;
    return project(triangles_.world_corners(number), number, camera_, counts);
  }

  [[nodiscard]] std::size_t pixel_at(std::uint32_t column, std::uint32_t row) const {
    return static_cast<std::size_t>(row) * camera_.width + column;
  }

  TriangleSource triangles_;
  const Camera& camera_;
  Cull cull_;
};

using Chunks = std::vector<std::vector<PlacedHit>>;

Chunks find_hits(const HitFinder& finder, const std::function<void(double)>& report) {
  constexpr std::uint64_t chunk = 256;
  const std::uint64_t count = finder.triangle_count();
  Chunks found((count + chunk - 1) / chunk);
  Progress progress(report, found.size());
  parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    for (std::uint64_t i = k * chunk; i < std::min(count, (k + 1) * chunk); ++i)
      finder.append_hits(static_cast<std::uint32_t>(i), found[k]);
    progress.part_done();
  });
  return found;
}

PixelHits by_pixels(const Chunks& found, std::size_t pixels) {
  PixelHits sorted;
  sorted.splits.resize(pixels + 1);
  for (const auto& chunk : found)
    for (const PlacedHit& each : chunk) ++sorted.splits[each.pixel + 1];
  std::inclusive_scan(sorted.splits.begin(), sorted.splits.end(), sorted.splits.begin());
  sorted.hits.resize(sorted.splits.back());
  std::vector<std::size_t> next(sorted.splits.begin(), sorted.splits.end() - 1);
  for (const auto& chunk : found)
    for (const PlacedHit& each : chunk) sorted.hits[next[each.pixel]++] = each.hit;
  return sorted;
}

}  // namespace

PixelHits hits_of_pixels(const Scene& scene, const Camera& camera, Cull cull, int threads,
                         const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  return with_threads(threads, [&] {
    require_renderable(scene, camera);
    const HitFinder finder(scene, camera, cull);
    const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
    PixelHits found = by_pixels(find_hits(finder, progress), pixels);
    parallel_for(std::size_t{0}, pixels, [&](std::size_t p) {
      finder.sort(p, found.hits.data() + found.splits[p], found.hits.data() + found.splits[p + 1]);
    });
    return found;
  });
}

}  // namespace fathom
