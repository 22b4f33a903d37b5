#include "fathom/fast/render_fast.h"

#include <algorithm>
#include <optional>
#include <span>

#include "fathom/fast/coverage/tile_coverage.h"
#include "fathom/fast/frame.h"
#include "fathom/fast/render_memory_parts.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: render_in_arena() is the whole story. Vertices are transformed to the
// image with bounds on their errors (vertex), triangles are sorted into tiles (boxes, bins), and
// each tile draws its triangles (setup, tile) and writes what is visible (resolve) and how much of
// its pixels is covered (tile_coverage). What the bounds do not settle goes to the referee
// (triangle/referee), which computes exactly.
namespace fathom {
using namespace fast;
using namespace triangle;

namespace {

constexpr std::uint32_t parts_of_scene = 64;

ImageObjects transform(const Scene& scene, const Camera& camera, VertexMemory* kept) {
  ImageObjects objects;
  TriangleSource(scene).for_each_part(0, [&](const TriangleSource::Part& part) {
    objects.emplace_back(part.object, part.mesh, camera, part.first_number, kept);
  });
  return objects;
}

bool is_by_area(const RenderOptions& options) {
  return std::count(options.channels.begin(), options.channels.end(), Channel::A) != 0;
}

/// The tiles that are drawn: all of an image, or some.
class TilesToDraw {
 public:
  explicit TilesToDraw(const TileGrid& grid) : count_(grid.count()) {}
  explicit TilesToDraw(std::span<const std::uint32_t> numbers)
      : count_(static_cast<std::uint32_t>(numbers.size())), numbers_(numbers.data()) {}
  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] std::uint32_t number(std::uint32_t i) const { return numbers_ ? numbers_[i] : i; }

 private:
  std::uint32_t count_;
  const std::uint32_t* numbers_ = nullptr;
};

DepthMap render_in_arena(const Scene& scene, const Camera& camera, const RenderOptions& options,
                         RenderMemory::Parts& memory, DepthMap before,
                         const std::optional<std::span<const std::uint32_t>>& some_tiles = {}) {
  FastFrame frame(camera, options);
  const TriangleSource triangles(scene);
  const SceneRays rays(triangles, camera);
  PerThread<TakenTile> tiles([&] { return TakenTile(memory.tiles); });
  FastWorkers workers([&] { return FastWorker(triangles, camera, rays); });

  frame.by_area = is_by_area(options);
  const TilesToDraw to_draw = some_tiles ? TilesToDraw(*some_tiles) : TilesToDraw(frame.grid);

  const ImageObjects objects = transform(scene, camera, options.kept ? &memory.vertices : nullptr);
  memory.vertices.forget();
  const std::vector<Bins>& bins = memory.bins =
      sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles.count()), parts_of_scene,
                      frame, workers, std::move(memory.bins));

  const MapRows rows{.past_caches = !before.channels.empty()};
  auto [map, background] = make_unfilled_map(camera, options, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  float* const coverage = writer.values().coverage;
  const CoverageFrame coverage_frame{triangles, camera, options.cull};
  PerThread<TileCoverage> coverages([&] {
    return TileCoverage({coverage_frame, objects, bins, rows});
  });
  FastOutput output(map, writer, rays, std::move(background), rows);
  FirstFault fault;
  Progress progress(options.progress, to_draw.count());
  parallel_for(std::uint32_t{0}, to_draw.count(), [&](std::uint32_t i) {
    const std::uint32_t number = to_draw.number(i);
    const auto is_empty = [&](const Bins& part) { return part.is_empty(number); };
    if (std::all_of(bins.begin(), bins.end(), is_empty)) {
      output.write_background(frame.grid.area(number), camera.width);
    } else {
      const Tile::Context context = frame.context(workers.local());
      Tile& tile = *tiles.local();
      tile.start(frame.grid.area(number));
      draw_tile(tile, number, bins, objects, context);
      fault.add(output.write(tile, camera.width, context));
      if (coverage) coverages.local().write(tile, number, context, coverage, camera.width);
    }
    progress.part_done();
  });
  if (fault.get()) fail(*fault.get(), map);
  collect_doubtful(workers, camera, options);
  if (options.statistics) *options.statistics = sum_of(workers, triangles.count());
  return std::move(map);
}

std::vector<TileTouch> find_tiles_in_arena(const Scene& scene, const Camera& camera,
                                           const RenderOptions& options) {
  FastFrame frame(camera, options);
  const TriangleSource triangles(scene);
  const SceneRays rays(triangles, camera);
  FastWorkers workers([&] { return FastWorker(triangles, camera, rays); });
  frame.by_area = is_by_area(options);
  const ImageObjects objects = transform(scene, camera, nullptr);
  std::vector<TileTouch> touches;
  for (const Bins& part : sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles.count()),
                                          parts_of_scene, frame, workers)) {
    for (std::uint32_t tile = 0; tile < frame.grid.count(); ++tile) {
      for (const Side side : {Side::front, Side::back}) {
        for (const TileEntry& entry : part.in_tile(tile, side))
          touches.push_back({tile, entry.number});
      }
    }
  }
  if (options.statistics) *options.statistics = sum_of(workers, triangles.count());
  return touches;
}

/// work(memory), in as many threads as asked for, and what is wrong with a scene that has a fault.
template <class Work>
auto with_valid(const Scene& scene, const Camera& camera, const RenderOptions& options,
                const Work& work) {
  require_meaningful(options);
  RenderMemory for_once;
  RenderMemory::Parts& memory = (options.kept ? *options.kept : for_once).parts();
  return with_threads(options.threads, [&] {
    scene::require_renderable_but_elements(scene, camera);
    try {
      return work(memory);
    } catch (const scene::ElementFault&) {
      require_valid(scene);
      throw;
    }
  });
}

}  // namespace

DepthMap render_fast(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     DepthMap before) {
  return with_valid(scene, camera, options, [&](RenderMemory::Parts& memory) {
    return render_in_arena(scene, camera, options, memory, std::move(before));
  });
}

ImageTiles tiles_of(const Camera& camera) {
  const TileGrid grid(camera.width, camera.height);
  return {Tile::size, grid.columns, grid.rows};
}

std::vector<TileTouch> tiles_touched(const Scene& scene, const Camera& camera,
                                     const RenderOptions& options) {
  const StandardArithmetic standard;
  return with_valid(scene, camera, options, [&](RenderMemory::Parts&) {
    return find_tiles_in_arena(scene, camera, options);
  });
}

DepthMap render_tiles(const Scene& scene, const Camera& camera, const RenderOptions& options,
                      std::span<const std::uint32_t> tiles) {
  const StandardArithmetic standard;
  return with_valid(scene, camera, options, [&](RenderMemory::Parts& memory) {
    return render_in_arena(scene, camera, options, memory, {}, tiles);
  });
}

}  // namespace fathom
