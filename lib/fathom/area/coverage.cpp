#include "fathom/area/coverage.h"

#include "fathom/area/cell_coverage.h"
#include "fathom/area/equal_triangles.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace area;
using namespace triangle;

namespace {

/// Adds what the triangles cover of the pixel, until nothing is left to cover.
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

}  // namespace fathom
