#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// A triangle at the centre of a pixel.
struct PixelHit {
  std::uint32_t triangle = 0;
  /// The planar depth in scene units, rounded once.
  double depth = 0;

  friend bool operator==(const PixelHit&, const PixelHit&) = default;
};

/// The hits of pixel p, counted row by row, are hits[splits[p]], …, hits[splits[p + 1] − 1].
struct PixelHits {
  std::vector<std::size_t> splits{0};
  std::vector<PixelHit> hits;
};

/// Every triangle at the centre of each pixel that can be visible there: it covers the sample,
/// D > 0, near ≤ D ≤ far, and culling keeps it. Nearest first, ties by number: the first of a pixel
/// is the visible one. probe() lists the same triangles of one pixel.
///
/// Exact    everything; depths are rounded once.
/// Cost     as render_reference(), and an exact depth for each triangle at each pixel; 40 bytes for
///          each hit while hits are sorted.
/// Fails    InputError if scene or camera has a fault (find_fault); UsageError if a lens bends
///          rays, or as require_thread_count(). `progress` is called as in RenderContext.
PixelHits hits_of_pixels(const Scene& scene, const Camera& camera, Cull cull = Cull::none,
                         int threads = 0, const std::function<void(double)>& progress = {});

}  // namespace fathom
