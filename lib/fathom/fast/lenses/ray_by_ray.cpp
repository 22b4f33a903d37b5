#include "fathom/fast/lenses/ray_by_ray.h"

#include <optional>
#include <vector>

#include "fathom/threads/threads.h"
#include "fathom/triangle/ray_referee.h"

namespace fathom::fast {
using namespace triangle;

namespace {

/// The triangles that are kept; counts the others.
std::vector<std::uint32_t> kept_triangles(const RayByRay& image, RenderStatistics& statistics) {
  RayReferee referee(image.triangles, image.camera);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t number = 0; number < image.triangles.count(); ++number) {
    const ProjectedTriangle& t = referee.projected(number);
    if (t.orientation == Sign::zero) {
      ++statistics.degenerate_triangles;
    } else if (!is_kept(t, image.cull)) {
      ++statistics.culled_triangles;
    } else {
      kept.push_back(number);
    }
  }
  return kept;
}

/// The visible triangle along a ray.
std::optional<std::uint32_t> nearest_along(const lens::ExactDirection& d,
                                           const std::vector<std::uint32_t>& triangles,
                                           RayReferee& referee, RenderStatistics& statistics) {
  std::optional<std::uint32_t> nearest;
  for (const std::uint32_t number : triangles) {
    ++statistics.samples_tested;
    if (!referee.covers(number, d, statistics)) continue;
    if (!referee.is_in_range(number, d, statistics)) continue;
    ++statistics.samples_covered;
    if (!nearest || referee.hides(number, *nearest, d, statistics)) nearest = number;
  }
  return nearest;
}

}  // namespace

void RayByRay::write(ChannelWriter& writer, RenderStatistics& statistics, FirstFault& fault) const {
  const std::vector<std::uint32_t> kept = kept_triangles(*this, statistics);
  std::vector<RenderStatistics> of_rows(camera.height);
  parallel_for(std::uint32_t{0}, camera.height, [&](std::uint32_t row) {
    RayReferee referee(triangles, camera);
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const std::size_t pixel = std::size_t{row} * camera.width + column;
      const auto d = preimages.of_pixel(column, row);
      if (std::uint32_t* const valid = writer.values().valid) valid[pixel] = d ? 1 : 0;
      if (!d) continue;
      const auto nearest = nearest_along(*d, kept, referee, of_rows[row]);
      if (!nearest) continue;
      ++of_rows[row].pixels_with_surface;
      fault.add(writer.write(pixel, referee.projected(*nearest), *d));
    }
  });
  for (const RenderStatistics& part : of_rows) add(statistics, part);
}

}  // namespace fathom::fast
