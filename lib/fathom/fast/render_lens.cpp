#include "fathom/fast/render_lens.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/fast/channels/fast_output.h"
#include "fathom/fast/lenses/lens_output.h"
#include "fathom/fast/lenses/lens_tile.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/ray_by_ray.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/render_memory_parts.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/rendering/map_of_camera.h"
#include "fathom/scene/scene_fault.h"

// How to read this file: render_in_window() is the whole story. Places says where the rays of all
// samples meet the plane z = 1; the Window is a camera with straight edges that sees this part of
// it. Vertices are transformed to the window and triangles sorted into its tiles, as without a
// lens. Each tile of the image draws the triangles of those tiles of the window in which its
// samples lie (lens_tile), and writes what is visible (lens_output).
namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

/// A thread's tools for lenses; those for the window are its FastWorker.
struct LensWorker {
  LensWorker(const TriangleSource& triangles, const Camera& camera, ChannelWriter& writer)
      : referee(triangles, camera),
        tile(std::make_unique<LensTile>()),
        output(writer, camera.width),
        taken(triangles.count() / 64 + 1, 0) {}

  RayReferee referee;
  std::unique_ptr<LensTile> tile;
  LensOutput output;
  /// A bit for each triangle: whether it is among those of the tile.
  std::vector<std::uint64_t> taken;
};

/// The triangles of one side in tiles of the window, each once.
class Gathered {
 public:
  Gathered(std::vector<TileEntry>& entries, std::vector<std::uint64_t>& taken)
      : entries_(entries), taken_(taken) {
    entries_.clear();
  }
  ~Gathered() {
    for (const TileEntry& entry : entries_) taken_[entry.number / 64] = 0;
  }
  Gathered(const Gathered&) = delete;
  Gathered& operator=(const Gathered&) = delete;

  void add(const std::vector<Bins>& all_bins, std::uint32_t tile, Side side) {
    for (const Bins& bins : all_bins) {
      for (const TileEntry& entry : bins.in_tile(tile, side)) {
        const std::uint64_t bit = std::uint64_t{1} << entry.number % 64;
        if (taken_[entry.number / 64] & bit) continue;
        taken_[entry.number / 64] |= bit;
        entries_.push_back(entry);
      }
    }
  }
  /// Leaves out what is certainly hidden by surfaces that are nowhere farther than a q.
  void leave_out_behind(float farthest) {
    const auto is_hidden = [&](const TileEntry& entry) {
      return std::bit_cast<float>(entry.nearness & nearness_of_q) < farthest;
    };
    const auto hidden =
        std::ranges::partition(entries_, [&](const TileEntry& entry) { return !is_hidden(entry); });
    for (const TileEntry& entry : hidden) taken_[entry.number / 64] = 0;
    entries_.erase(hidden.begin(), hidden.end());
  }

 private:
  std::vector<TileEntry>& entries_;
  std::vector<std::uint64_t>& taken_;
};

/// The scene in the window, for all threads.
struct WindowScene {
  const ImageObjects& objects;
  const std::vector<Bins>& bins;
  const TileGrid& grid;
};

void draw_side(LensTile& tile, Side side, const WindowScene& scene,
               std::vector<std::uint64_t>& taken, const LensContext& context) {
  const PixelBox& area = tile.where().area;
  const DrawContext& window = context.window;
  Gathered gathered(window.visible.entries(), taken);
  for (std::uint32_t row = area.first_row / Tile::size; row <= area.last_row / Tile::size; ++row) {
    for (std::uint32_t column = area.first_column / Tile::size;
         column <= area.last_column / Tile::size; ++column) {
      gathered.add(scene.bins, row * scene.grid.columns + column, side);
    }
  }
  if (side == Side::back && window.switches.early_rejection)
    gathered.leave_out_behind(tile.farthest());
  window.visible.for_each_part(tile.tile(), false, [&](std::span<const std::uint32_t> numbers) {
    for_each_object(numbers, scene.objects,
                    [&](const ImageObject& object, std::span<const std::uint32_t> of_object) {
                      tile.draw(object, of_object, context);
                    });
  });
}

/// The places of a camera's samples, from the frame before where they are the same.
const Places& places_of(const Camera& camera, RenderMemory::Parts& memory) {
  if (!memory.places || !memory.places->are_of(camera.projection, camera.width, camera.height)) {
    memory.places.reset();
    memory.places = std::make_unique<const Places>(camera.projection, camera.width, camera.height);
  }
  return *memory.places;
}

Rendered render_ray_by_ray(const Scene& scene, const Camera& camera, const RenderOptions& options,
                           const RenderContext& context, const Places& places, DepthMap before) {
  const TriangleSource triangles(scene);
  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  RenderStatistics statistics;
  statistics.triangles = triangles.count();
  FirstFault fault;
  RayByRay{triangles, camera, options.cull, places.preimages()}.write(writer, statistics, fault);
  if (fault.get()) fail(*fault.get(), map);
  return {std::move(map), statistics, {}};
}

Rendered render_in_window(const Scene& scene, const Camera& camera, const RenderOptions& options,
                          const RenderContext& context, const Places& places,
                          RenderMemory::Parts& memory, DepthMap before) {
  const Window window(camera, places);
  FastFrame frame(window.camera, options, context.kept != nullptr);
  frame.by_area = true;  // samples lie anywhere in a window's pixels
  const TriangleSource triangles(scene);
  const SceneRays rays(triangles, window.camera);
  FastWorkers workers([&] { return FastWorker(triangles, window.camera, rays); });
  const ImageObjects objects =
      image_objects(triangles, window.camera, context.kept ? &memory.vertices : nullptr);
  memory.vertices.forget();
  const std::vector<Bins>& bins = memory.bins =
      sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles.count()), parts_of_scene,
                      frame, workers, std::move(memory.bins));

  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  PerThread<LensWorker> lens_workers([&] { return LensWorker(triangles, camera, writer); });
  const TileGrid image(camera.width, camera.height);
  FirstFault fault;
  Progress progress(context.progress, image.count());
  parallel_for(std::uint32_t{0}, image.count(), [&](std::uint32_t number) {
    LensWorker& worker = lens_workers.local();
    const Places::OfTile of_tile = places.of_tile(number);
    if (of_tile.box.is_empty()) {
      worker.output.write_valid(image.area(number), of_tile);
    } else {
      const DrawContext drawing = frame.context(workers.local());
      const LensContext lens{drawing, worker.referee, places.preimages()};
      const WindowScene drawn{objects, bins, frame.grid};
      LensTile& tile = *worker.tile;
      tile.start(image.area(number), of_tile, TileInWindow(window, of_tile));
      draw_side(tile, Side::front, drawn, worker.taken, lens);
      tile.begin_back_faces();
      draw_side(tile, Side::back, drawn, worker.taken, lens);
      fault.add(worker.output.write(tile, lens));
    }
    progress.part_done();
  });
  if (fault.get()) fail(*fault.get(), map);
  return {std::move(map), sum_of(workers, triangles.count()), doubtful_pixels(workers, camera)};
}

}  // namespace

Rendered render_lens(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context, RenderMemory::Parts& memory, DepthMap before) {
  if (counts_distance(camera.projection)) {
    throw UsageError("the lens " + std::string(name_of(camera.projection.lens->model)) +
                     ": is drawn by the reference engine only");
  }
  require_renderable_by_rays(scene, camera, LookAtElements::later);
  require_channels_of(camera, options);
  return scene::explaining_faults(scene, [&] {
    const Places& places = places_of(camera, memory);
    if (!places.are_usable())
      return render_ray_by_ray(scene, camera, options, context, places, std::move(before));
    return render_in_window(scene, camera, options, context, places, memory, std::move(before));
  });
}

}  // namespace fathom::fast
