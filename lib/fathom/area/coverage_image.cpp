#include "fathom/area/coverage_image.h"

#include <algorithm>
#include <array>

#include "fathom/area/cell_coverage.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/triangle_boxes.h"

namespace fathom::area {
namespace {

using Corners = std::array<WorldPoint, 3>;

bool same_place(const WorldPoint& a, const WorldPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Does not depend on which corner comes first.
std::size_t hash_of(const Corners& corners) {
  std::size_t sum = 0;
  for (const WorldPoint& p : corners) {
    std::size_t hash = 0;
    for (const Dyadic* x : {&p.x, &p.y, &p.z}) hash = hash * 31 + fathom::hash_of(*x);
    sum += hash ^ hash >> 29;
  }
  return sum;
}

bool have_same_corners(const Corners& a, Corners b) {
  for (int turn = 0; turn < 3; ++turn) {
    if (std::equal(a.begin(), a.end(), b.begin(), same_place)) return true;
    std::rotate(b.begin(), b.begin() + 1, b.end());
  }
  return false;
}

}  // namespace

bool EqualTriangles::is_first(std::uint32_t number) {
  const Corners corners = triangles_.world_corners(number);
  const std::size_t hash = hash_of(corners);
  if (2 * count_ >= table_.size()) grow();
  std::size_t place = place_of(hash);
  for (; table_[place].number; place = (place + 1) % table_.size()) {
    const auto& [other_hash, other] = table_[place];
    if (other_hash == hash && have_same_corners(triangles_.world_corners(*other), corners))
      return false;
  }
  table_[place] = {hash, number};
  ++count_;
  return true;
}

/// Where the search for a hash begins: its best mixed bits after a multiplication by 2⁶⁴ over the
/// golden ratio.
std::size_t EqualTriangles::place_of(std::size_t hash) const {
  return (std::uint64_t{hash} * 0x9e3779b97f4a7c15U >> 32U) % table_.size();
}

void EqualTriangles::grow() {
  std::vector<First> before(2 * table_.size());
  before.swap(table_);
  for (const First& first : before) {
    if (!first.number) continue;
    std::size_t place = place_of(first.hash);
    while (table_[place].number) place = (place + 1) % table_.size();
    table_[place] = first;
  }
}

using namespace triangle;

namespace {

constexpr std::uint32_t triangles_of_file = 1U << 19;
constexpr std::size_t triangles_per_chunk = 4096;

}  // namespace

TriangleBands::TriangleBands(const CoverageFrame& frame)
    : height_(frame.camera.height), bands_((height_ - 1) / rows_per_band + 1) {
  frame.triangles.for_each_part(triangles_of_file, [&](const TriangleSource::Part& part) {
    const std::size_t count = part.mesh.triangles.size();
    std::vector<std::vector<BoxedTriangle>> found((count + triangles_per_chunk - 1) /
                                                  triangles_per_chunk);
    parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
      TriangleBoxes boxes(part.object, part.mesh, frame.camera);
      const std::size_t end = std::min(count, (k + 1) * triangles_per_chunk);
      for (std::size_t i = k * triangles_per_chunk; i < end; ++i) {
        const auto triangle = static_cast<std::uint32_t>(i);
        const PixelBox box = boxes.box(triangle);
        if (!box.is_empty()) found[k].push_back({part.first_number + triangle, box});
      }
    });
    for (const auto& triangles : found) {
      for (const BoxedTriangle& triangle : triangles) {
        const std::uint32_t last = triangle.box.last_row / rows_per_band;
        for (std::uint32_t k = triangle.box.first_row / rows_per_band; k <= last; ++k) {
          bands_[k].push_back(triangle);
        }
      }
    }
  });
}

TriangleBands::Band TriangleBands::operator[](std::uint32_t band) const {
  const std::uint32_t first_row = band * rows_per_band;
  return {first_row, std::min(first_row + rows_per_band, height_), bands_[band]};
}

namespace {

/// The region of the image that a triangle covers, and a box around it.
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
