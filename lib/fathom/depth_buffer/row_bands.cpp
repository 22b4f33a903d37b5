#include "fathom/depth_buffer/row_bands.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "fathom/exact/verify_samples.h"

namespace fathom {
namespace {

constexpr std::uint32_t rows_per_band = 16;
constexpr std::size_t triangles_per_chunk = 4096;
constexpr std::uint32_t triangles_of_file = 1U << 19;

void add(std::vector<RowBand>& bands, const BoxedTriangle& t) {
  if (t.box.is_empty()) return;
  const std::uint32_t last = t.box.last_row / rows_per_band;
  for (std::uint32_t band = t.box.first_row / rows_per_band; band <= last; ++band) {
    bands[band].triangles.push_back(t);
  }
}

/// boxes_of(part)(i) is the box of triangle i of a part.
template <class BoxesOf>
void add_boxes(std::vector<RowBand>& bands, const TriangleSource& triangles,
               const BoxesOf& boxes_of) {
  triangles.for_each_part(triangles_of_file, [&](const TriangleSource::Part& part) {
    const std::size_t count = part.mesh.triangles.size();
    std::vector<PixelBox> boxes(count);
    const std::size_t chunks = (count + triangles_per_chunk - 1) / triangles_per_chunk;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t k) {
      auto box_of = boxes_of(part);
      const std::size_t end = std::min(count, (k + 1) * triangles_per_chunk);
      for (std::size_t i = k * triangles_per_chunk; i < end; ++i) {
        boxes[i] = box_of(static_cast<std::uint32_t>(i));
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      add(bands, {part.first_number + static_cast<std::uint32_t>(i), boxes[i]});
    }
  });
}

}  // namespace

std::vector<RowBand> row_bands(const Camera& camera) {
  std::vector<RowBand> bands;
  for (std::uint32_t row = 0; row < camera.height; row += rows_per_band) {
    bands.push_back({row, std::min(row + rows_per_band, camera.height), {}});
  }
  return bands;
}

void add_certified_boxes(std::vector<RowBand>& bands, const TriangleSource& triangles,
                         const Camera& camera) {
  add_boxes(bands, triangles, [&](const TriangleSource::Part& part) {
    return [boxes = TriangleBoxes(part.object, part.mesh, camera)](std::uint32_t i) mutable {
      return boxes.box(i);
    };
  });
}

void add_exact_boxes(std::vector<RowBand>& bands, const TriangleSource& triangles,
                     const Camera& camera) {
  add_boxes(bands, triangles, [&](const TriangleSource::Part& part) {
    return [&](std::uint32_t i) {
      TierCounts counts;
      const ProjectedTriangle t =
          project(world_corners(part.object, part.mesh, i), part.first_number + i, camera, counts);
      return t.orientation == Sign::zero ? PixelBox{} : bounding_box(t, camera);
    };
  });
}

}  // namespace fathom
