#include "fathom/fast/render_lens.h"

#include <algorithm>
#include <memory>
#include <utility>

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

// How to read this file: LensImage::draw() is the whole story. Places contains where the rays of
// all samples meet a plane at distance 1: of a lens of the plane z = 1, of others in one of six
// views. The Window is a camera with straight edges that sees this part of the plane. Vertices are
// transformed to the window and triangles sorted into its tiles, as without a lens. Each tile of
// the image draws the triangles of those tiles of the window in which its samples lie (lens_tile),
// and writes the visible surfaces (lens_output).
namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

/// A thread's tools for lenses; those for the window are its FastWorker.
struct LensWorker {
  LensWorker(const TriangleSource& triangles, const Camera& camera, ChannelWriter& writer)
      : referee(triangles, camera),
        tile(std::make_unique<LensTile>()),
        places(std::make_unique<Places::Room>()),
        output(writer, camera.width),
        taken(triangles.count() / 64 + 1, 0) {}

  RayReferee referee;
  std::unique_ptr<LensTile> tile;
  std::unique_ptr<Places::Room> places;
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

void write_valid(const Places& places, const TileGrid& image, std::uint32_t* valid) {
  if (valid == nullptr) return;
  parallel_for(std::uint32_t{0}, image.count(), [&](std::uint32_t tile) {
    const PixelBox area = image.area(tile);
    for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
      for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
        const std::size_t i = Tile::index(column - area.first_column, row - area.first_row);
        valid[std::size_t{row} * image.width + column] = places.has_ray(tile, i) ? 1 : 0;
      }
    }
  });
}

/// An image that windows hold, one for each of its views.
class LensImage {
 public:
  LensImage(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
            const RenderContext& context, const Places& places, RenderMemory::Parts& memory,
            ChannelWriter& writer)
      : triangles_(triangles),
        camera_(camera),
        options_(options),
        context_(context),
        places_(places),
        memory_(memory),
        image_(camera.width, camera.height),
        workers_([&] { return LensWorker(triangles, camera, writer); }),
        progress_(context.progress, image_.count() * places.views().size()) {}

  void draw(const Places::View& view);

  [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const std::vector<std::uint64_t>& doubtful() const { return doubtful_; }
  [[nodiscard]] const FirstFault& fault() const { return fault_; }

 private:
  void draw_tile(std::uint32_t number, const Places::View& view, const Window& window,
                 const WindowScene& scene, const DrawContext& context);
  void count(const FastWorkers& workers);

  const TriangleSource& triangles_;
  const Camera& camera_;
  const RenderOptions& options_;
  const RenderContext& context_;
  const Places& places_;
  RenderMemory::Parts& memory_;
  TileGrid image_;
  PerThread<LensWorker> workers_;
  Progress progress_;
  FirstFault fault_;
  RenderStatistics statistics_;
  std::vector<std::uint64_t> doubtful_;
};

void LensImage::draw(const Places::View& view) {
  const Window window(camera_, view);
  FastFrame frame(window.camera, options_, context_.kept != nullptr);
  frame.by_area = true;  // samples lie anywhere in a window's pixels
  frame.range = window.range;
  const SceneRays rays(triangles_, window.camera);
  FastWorkers workers([&] { return FastWorker(triangles_, window.camera, rays); });
  const ImageObjects objects =
      image_objects(triangles_, window.camera, context_.kept ? &memory_.vertices : nullptr);
  memory_.vertices.forget();
  const std::vector<Bins>& bins = memory_.bins =
      sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles_.count()), parts_of_scene,
                      frame, workers, std::move(memory_.bins));
  const WindowScene scene{objects, bins, frame.grid};
  parallel_for(std::uint32_t{0}, image_.count(), [&](std::uint32_t number) {
    if (!view.boxes[number].is_empty())
      draw_tile(number, view, window, scene, frame.context(workers.local()));
    progress_.part_done();
  });
  count(workers);
}

void LensImage::draw_tile(std::uint32_t number, const Places::View& view, const Window& window,
                          const WindowScene& scene, const DrawContext& context) {
  LensWorker& worker = workers_.local();
  const LensContext lens{context, worker.referee, places_.preimages(), window.axes};
  const Places::OfTile of_tile = places_.of_tile(view, number, *worker.places);
  LensTile& tile = *worker.tile;
  tile.start(image_.area(number), of_tile, TileInWindow(window, of_tile));
  draw_side(tile, Side::front, scene, worker.taken, lens);
  tile.begin_back_faces();
  draw_side(tile, Side::back, scene, worker.taken, lens);
  fault_.add(worker.output.write(tile, lens));
}

/// Triangles are counted in the first view only: they are the same in each.
void LensImage::count(const FastWorkers& workers) {
  RenderStatistics of_view = sum_of(workers, triangles_.count());
  if (statistics_.triangles != 0)
    of_view.triangles = of_view.degenerate_triangles = of_view.culled_triangles = 0;
  add(statistics_, of_view);
  const std::vector<std::uint64_t> doubtful = doubtful_pixels(workers, camera_);
  doubtful_.insert(doubtful_.end(), doubtful.begin(), doubtful.end());
}

Rendered render_in_windows(const Scene& scene, const Camera& camera, const RenderOptions& options,
                           const RenderContext& context, const Places& places,
                           RenderMemory::Parts& memory, DepthMap before) {
  const TriangleSource triangles(scene);
  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  write_valid(places, {camera.width, camera.height}, writer.values().valid);
  LensImage image(triangles, camera, options, context, places, memory, writer);
  for (const Places::View& view : places.views()) image.draw(view);
  if (image.fault().get()) fail(*image.fault().get(), map);
  return {std::move(map), image.statistics(), image.doubtful()};
}

}  // namespace

Rendered render_lens(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context, RenderMemory::Parts& memory, DepthMap before) {
  require_renderable_by_rays(scene, camera, LookAtElements::later);
  require_channels_of(camera, options);
  return scene::explaining_faults(scene, [&] {
    const Places& places = places_of(camera, memory);
    if (!places.are_usable())
      return render_ray_by_ray(scene, camera, options, context, places, std::move(before));
    return render_in_windows(scene, camera, options, context, places, memory, std::move(before));
  });
}

}  // namespace fathom::fast
