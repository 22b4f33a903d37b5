#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/fast/tiles/visible_triangles.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

/// The working data of the fast engine, whether its scene is in memory or in files.
namespace fathom::fast {

/// The working data of a thread.
struct FastWorker {
  FastWorker(const TriangleSource& triangles, const Camera& camera, const triangle::SceneRays& rays)
      : referee(triangles, camera, &rays),
        exact_setups({0, camera.width - 1, 0, camera.height - 1}) {}
  triangle::Referee referee;
  ExactSetups exact_setups;
  VisibleTriangles visible;
  RenderStatistics statistics;
  std::vector<DoubtfulPixel> doubtful;
};
using FastWorkers = PerThread<FastWorker>;

/// The sum of the statistics of all threads.
RenderStatistics sum_of(const FastWorkers& workers, std::uint64_t triangles);

/// The doubtful pixels of all threads: Rendered::doubtful.
std::vector<std::uint64_t> doubtful_pixels(const FastWorkers& workers, const Camera& camera);

/// The data that all threads share.
struct FastFrame {
  /// `keeps_memory`: whether bins are filled again for another frame.
  FastFrame(const Camera& camera, const RenderOptions& options, bool keeps_memory = false);

  [[nodiscard]] DrawContext context(FastWorker& worker) const {
    return {.referee = worker.referee,
            .statistics = worker.statistics,
            .range = range,
            .perspective = perspective,
            .switches = options.fast,
            .doubtful = options.fast.find_doubtful ? &worker.doubtful : nullptr,
            .exact_setups = worker.exact_setups,
            .visible = worker.visible,
            .by_area = by_area};
  }

  const Camera& camera;
  const RenderOptions& options;
  bool keeps_memory;
  TileGrid grid;
  DepthRange range;
  bool perspective;
  /// Whether tiles get all triangles that meet them, for channel A.
  bool by_area;
};

/// All objects of a scene that is in memory, in the image of a camera with straight edges.
ImageObjects image_objects(const TriangleSource& triangles, const Camera& camera,
                           VertexMemory* kept);

/// Parts of a whole scene, and of a chunk of a stream, for sort_into_tiles().
inline constexpr std::uint32_t parts_of_scene = 64;
inline constexpr std::uint32_t parts_of_chunk = 8;

/// Sorts triangles [first, end) of the scene, all of which belong to these objects, into tiles:
/// into at most `parts` bins of equal length, so that each thread has several and their tables of
/// tiles stay small. `bins` lend their memory, and keep it if the frame requests so.
std::vector<Bins> sort_into_tiles(const ImageObjects& objects, std::uint32_t first,
                                  std::uint32_t end, std::uint32_t parts, const FastFrame& frame,
                                  FastWorkers& workers, std::vector<Bins> bins = {});

/// Calls visit(object, numbers) for triangles of several objects, which are grouped by object.
template <class Visit>
void for_each_object(std::span<const std::uint32_t> numbers, const ImageObjects& objects,
                     const Visit& visit) {
  while (!numbers.empty()) {
    const ImageObject& object = object_of(objects, numbers.front());
    const auto next = std::find_if(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
      return number < object.first_number || number >= object.end_number();
    });
    const auto count = static_cast<std::size_t>(next - numbers.begin());
    visit(object, numbers.first(count));
    numbers = numbers.subspan(count);
  }
}

/// Draws the triangles of a tile.
void draw_tile(Tile& tile, std::uint32_t number, const std::vector<Bins>& all_bins,
               const ImageObjects& objects, const DrawContext& context);

}  // namespace fathom::fast
