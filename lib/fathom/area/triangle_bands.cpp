#include "fathom/area/triangle_bands.h"

#include <algorithm>

#include "fathom/threads/threads.h"
#include "fathom/triangle/triangle_boxes.h"

namespace fathom::area {
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

}  // namespace fathom::area
