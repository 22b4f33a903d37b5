#include "fathom/fast/render_fast.h"

#include <utility>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/coverage/tile_coverage.h"
#include "fathom/fast/render_lens.h"
#include "fathom/fast/render_memory_parts.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: start with render_in_arena(). Vertices are transformed to the image with
// bounds on their errors (vertex), triangles are sorted into tiles (boxes, bins), and each tile
// draws its triangles (setup, tile), writes the visible surfaces (resolve) and the covered share of
// its pixels (tile_coverage). Decisions that the bounds do not settle go to the referee
// (triangle/referee), which computes exactly.
namespace fathom {
using namespace fast;
using namespace rendering;
using namespace triangle;

namespace {

Rendered render_in_arena(const Scene& scene, const Camera& camera, const RenderOptions& options,
                         const RenderContext& context, RenderMemory::Parts& memory,
                         DepthMap before) {
  const FastFrame frame(camera, options, context.kept != nullptr);
  const TriangleSource triangles(scene);
  const SceneRays rays(triangles, camera);
  PerThread<TakenTile> tiles([&] { return TakenTile(memory.tiles); });
  FastWorkers workers([&] { return FastWorker(triangles, camera, rays); });

  const ImageObjects objects =
      image_objects(triangles, camera, context.kept ? &memory.vertices : nullptr);
  memory.vertices.forget();
  const std::vector<Bins>& bins = memory.bins =
      sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles.count()), parts_of_scene,
                      frame, workers, std::move(memory.bins));

  const MapRows rows{.past_caches = !before.channels.empty()};
  auto [map, background] = make_unfilled_map(camera, options, context, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  float* const coverage = writer.values().coverage;
  const CoverageFrame coverage_frame{triangles, camera, options.cull};
  PerThread<TileCoverage> coverages([&] {
    return TileCoverage({coverage_frame, objects, bins, rows});
  });
  FastOutput output(map, writer, rays, std::move(background), rows);
  const MapLayout layout{camera.width};
  FirstFault fault;
  Progress progress(context.progress, frame.grid.count());
  parallel_for(std::uint32_t{0}, frame.grid.count(), [&](std::uint32_t number) {
    if (!is_met(bins, number)) {
      output.write_background(frame.grid.area(number), layout);
    } else {
      const DrawContext drawing = frame.context(workers.local());
      Tile& tile = *tiles.local();
      tile.start(frame.grid.area(number));
      draw_tile(tile, number, bins, objects, drawing);
      fault.add(output.write(tile, layout, drawing));
      if (coverage) coverages.local().write(tile, number, drawing, coverage, layout);
    }
    progress.part_done();
  });
  if (fault.get()) fail(*fault.get(), map);
  return {std::move(map), sum_of(workers, triangles.count()), doubtful_pixels(workers, camera)};
}

}  // namespace

Rendered render_fast(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context, DepthMap before) {
  const StandardArithmetic standard;
  require_meaningful(options);
  RenderMemory for_once;
  RenderMemory::Parts& memory = (context.kept ? *context.kept : for_once).parts();
  return with_threads(options.threads, [&] {
    if (bends_rays(camera.projection)) {
      return render_lens(scene, camera, options, context, memory, std::move(before));
    }
    require_renderable(scene, camera, LookAtElements::later);
    return scene::explaining_faults(scene, [&] {
      return render_in_arena(scene, camera, options, context, memory, std::move(before));
    });
  });
}

const char* vector_instructions() {
  return vector_target();
}

}  // namespace fathom
