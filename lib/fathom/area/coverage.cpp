#include "fathom/area/coverage.h"

#include <algorithm>
#include <bitset>

#include "fathom/area/cell_coverage.h"
#include "fathom/area/coverage_image.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/referee.h"

// How to read this file: pixel_coverage() and rounded_pixel_coverage() compute the exact coverage
// of a pixel. add_sampled_coverage() at the end computes coverage by samples: bands of rows are
// filled one by one, and each triangle is tested at the samples of its box that no other has
// covered.
namespace fathom {
using namespace area;
using namespace rendering;
using namespace triangle;

namespace {

/// Adds the parts of the pixel that the triangles cover, until the whole pixel is covered.
void add(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
         CellCoverage& coverage) {
  require_valid(frame.camera);
  TierCounts counts;
  EqualTriangles equal(frame.triangles);
  for (const std::uint32_t number : triangles) {
    if (coverage.is_complete()) return;
    if (!equal.is_first(number)) continue;
    const ProjectedTriangle t =
        project(frame.triangles.world_corners(number), number, frame.camera, counts);
    if (!is_kept(t, frame.cull)) continue;
    if (const auto region = covered_region(t, frame.camera)) coverage.add(*region);
  }
}

}  // namespace

Ratio pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                     std::uint32_t column, std::uint32_t row) {
  const StandardArithmetic standard;
  ImageCell pixel(column, row);
  CellCoverage coverage(pixel);
  add(frame, triangles, coverage);
  return coverage.area();
}

float rounded_pixel_coverage(const CoverageFrame& frame, std::span<const std::uint32_t> triangles,
                             std::uint32_t column, std::uint32_t row) {
  const StandardArithmetic standard;
  ImageCell pixel(column, row);
  CellCoverage coverage(pixel);
  add(frame, triangles, coverage);
  return coverage.rounded_area();
}

namespace {

constexpr std::size_t most_samples = 256;
using Covered = std::bitset<most_samples>;

/// Whether triangles count at samples, by exact numbers alone.
class ExactSamples {
 public:
  ExactSamples(const TriangleSource& triangles, const Camera& camera, Cull cull)
      : triangles_(triangles), camera_(camera), cull_(cull) {}

  /// False if the triangle counts nowhere.
  bool take(std::uint32_t number) {
    TierCounts counts;
    triangle_ = project(triangles_.world_corners(number), number, camera_, counts);
    return triangle_.orientation != Sign::zero && is_kept(triangle_, cull_);
  }
  bool counts_at(const ImagePoint& s) {
    TierCounts counts;
    return covers(triangle_, s, counts) && is_in_range(depth_at(triangle_, s), camera_);
  }

 private:
  TriangleSource triangles_;
  const Camera& camera_;
  Cull cull_;
  ProjectedTriangle triangle_;
};

/// Whether triangles count at samples, by bounds where they settle it.
class CertifiedSamples {
 public:
  CertifiedSamples(const TriangleSource& triangles, const Camera& camera, Cull cull,
                   const SceneRays& rays)
      : camera_(camera), cull_(cull), surfaces_(rays), referee_(triangles, camera, &rays) {}

  bool take(std::uint32_t number) {
    number_ = number;
    return cull_ == Cull::none || (referee_.projected(number).orientation != Sign::zero &&
                                   is_kept(referee_.projected(number), cull_));
  }
  bool counts_at(const ImagePoint& s) {
    if (surfaces_.certainly_misses(number_, s)) return false;
    RenderStatistics uncounted;
    if (surfaces_.certainly_covers(number_, s)) {
      const Certified<double> D = surfaces_.depth(number_, s);
      const double margin = 1 + 0x1p-50;
      if (D.value - D.error > camera_.near * margin && (D.value + D.error) * margin < camera_.far) {
        return true;
      }
    } else if (!referee_.covers(number_, s, uncounted)) {
      return false;
    }
    return referee_.is_in_range(number_, s, uncounted);
  }

 private:
  const Camera& camera_;
  Cull cull_;
  CertifiedSurfaces surfaces_;
  Referee referee_;
  std::uint32_t number_ = 0;
};

template <class SampleTest>
void fill(const TriangleBands::Band& band, const Camera& camera, const SamplePattern& pattern,
          SampleTest& test, float* shares) {
  std::vector<Covered> covered(static_cast<std::size_t>(band.end_row - band.first_row) *
                               camera.width);
  const std::size_t count = pattern.count();
  for (const BoxedTriangle& boxed : band.triangles) {
    check_interruption();
    if (!test.take(boxed.number)) continue;
    const PixelBox& box = boxed.box;
    const std::uint32_t end_row = std::min(box.last_row + 1, band.end_row);
    for (std::uint32_t row = std::max(box.first_row, band.first_row); row < end_row; ++row) {
      for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
        Covered& here =
            covered[static_cast<std::size_t>(row - band.first_row) * camera.width + column];
        for (std::size_t k = 0; k < count; ++k) {
          if (here[k]) continue;
          const SampleOffset offset = pattern.at(k, column, row);
          here[k] = test.counts_at({column + 0.5 + offset[0], row + 0.5 + offset[1]});
        }
      }
    }
  }
  float* first = shares + static_cast<std::size_t>(band.first_row) * camera.width;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    first[i] = static_cast<float>(covered[i].count()) / static_cast<float>(count);
  }
}

}  // namespace

void add_sampled_coverage(DepthMap& map, const TriangleSource& triangles, const Camera& camera,
                          const SamplePattern& pattern, const RenderOptions& options) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  require_map_of(camera, map);
  require_renderable(triangles, camera);
  require_valid(pattern);
  Samples<float> shares(static_cast<std::size_t>(map.width) * map.height);
  with_threads(options.threads, [&] {
    const TriangleBands bands({triangles, camera, options.cull});
    const SceneRays rays(triangles, camera);
    PerThread<CertifiedSamples> certified(
        [&] { return CertifiedSamples(triangles, camera, options.cull, rays); });
    parallel_for(std::uint32_t{0}, bands.count(), [&](std::uint32_t i) {
      if (options.engine == Engine::fast) {
        fill(bands[i], camera, pattern, certified.local(), shares.data());
      } else {
        ExactSamples exact(triangles, camera, options.cull);
        fill(bands[i], camera, pattern, exact, shares.data());
      }
    });
  });
  map.channels.push_back({"Asampled", std::move(shares)});
}

}  // namespace fathom
