#include "fathom/area/coverage_image.h"

#include "fathom/area/cell_coverage.h"
#include "fathom/area/equal_triangles.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
using namespace triangle;

namespace {

/// What a triangle covers of the image, and where.
struct BoxedRegion {
  SurfaceRegion surface;
  PixelBox box;
};

std::vector<BoxedRegion> regions_of(const CoverageFrame& frame, const TriangleBands::Band& band) {
  std::vector<BoxedRegion> regions;
  EqualTriangles equal(frame.triangles);
  TierCounts counts;
  for (const BoxedTriangle& triangle : band.triangles) {
    check_interruption();
    if (!equal.is_first(triangle.number)) continue;
    const ProjectedTriangle t = project(frame.triangles.world_corners(triangle.number),
                                        triangle.number, frame.camera, counts);
    if (!is_kept(t, frame.cull)) continue;
    if (auto surface = surface_region(t, frame.camera)) {
      regions.push_back({std::move(*surface), triangle.box});
    }
  }
  return regions;
}

void visit_row(const std::vector<BoxedRegion>& regions, std::uint32_t row, std::uint32_t width,
               const VisitPixel& visit) {
  std::vector<std::vector<const SurfaceRegion*>> columns(width);
  for (const BoxedRegion& r : regions) {
    if (r.box.first_row > row || r.box.last_row < row) continue;
    for (std::uint32_t column = r.box.first_column; column <= r.box.last_column; ++column) {
      columns[column].push_back(&r.surface);
    }
  }
  for (std::uint32_t column = 0; column < width; ++column) {
    if (columns[column].empty()) continue;
    check_interruption();
    visit(column, row, columns[column]);
  }
}

}  // namespace

void for_each_pixel(const CoverageFrame& frame, const VisitPixel& visit,
                    const std::function<void()>& part_done, const RowShare& share) {
  static_assert(TriangleBands::rows_per_band == RowShare::rows_per_band);
  const TriangleBands bands(frame);
  parallel_for(std::uint32_t{0}, bands.count(), [&](std::uint32_t k) {
    if (!share.has_band(k)) return;
    const TriangleBands::Band band = bands[k];
    const std::vector<BoxedRegion> regions = regions_of(frame, band);
    for (std::uint32_t row = band.first_row; row < band.end_row; ++row) {
      visit_row(regions, row, frame.camera.width, visit);
    }
    if (part_done) part_done();
  });
}

TierCounts write_coverage(const CoverageFrame& frame, float* values,
                          const std::function<void()>& part_done) {
  PerThread<TierCounts> counts;
  const auto write = [&](std::uint32_t column, std::uint32_t row,
                         std::span<const SurfaceRegion* const> triangles) {
    ImageCell pixel(column, row);
    CellCoverage coverage(pixel);
    for (const SurfaceRegion* t : triangles) coverage.add(t->region);
    values[static_cast<std::size_t>(row) * frame.camera.width + column] = coverage.rounded_area();
    counts.local() += coverage.decisions();
  };
  for_each_pixel(frame, write, part_done);
  TierCounts sum;
  counts.for_each([&](const TierCounts& part) { sum += part; });
  return sum;
}

}  // namespace fathom::area
