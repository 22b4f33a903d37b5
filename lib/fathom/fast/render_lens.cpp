#include "fathom/fast/render_lens.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/lenses/lens_output.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/render_memory_parts.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: start with LensImage::draw(). Places contains where the rays of all
// samples meet a plane at distance 1: of a lens of the plane z = 1, of others in one of six views.
// The Window is a camera with straight edges that sees this part of the plane. Vertices are
// transformed to the window and triangles sorted into its tiles, as without a lens. Each tile of
// the image draws the triangles of those tiles of the window in which its samples lie (lens_tile),
// and writes the visible surfaces (lens_output). StreamedView::draw() processes some triangles at a
// time as LensImage processes all; the tiles of a band keep the visible surfaces so far.
namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

/// Which triangles of a tile of the window may meet an area of it, by the blocks of their boxes.
class BlocksMet {
 public:
  BlocksMet(const PixelBox& area, std::uint32_t column, std::uint32_t row) {
    const auto [left, right] = blocks_of(area.first_column, area.last_column, column);
    const auto [top, bottom] = blocks_of(area.first_row, area.last_row, row);
    for (const std::size_t more : {0, 1}) {
      // A box has up to two, or up to four, blocks in a row and in a column, from its first one on.
      const std::uint32_t others = more == 0 ? 1 : 3;
      for (std::uint32_t y = top - std::min(top, others); y <= bottom; ++y)
        for (std::uint32_t x = left - std::min(left, others); x <= right; ++x)
          first_blocks_[more] |= std::uint64_t{1} << (y * Tile::blocks_of_row + x);
    }
  }

  /// Triangles that are drawn from exact numbers may be anywhere.
  [[nodiscard]] bool may_hold(Nearness n) const {
    const std::uint64_t first_blocks = first_blocks_[meets_more_than_two_blocks(n) ? 1 : 0];
    return (first_blocks >> block_of(n) & 1) != 0 || (n & nearness_of_q) == never_hidden;
  }

 private:
  /// The first and the last block of a tile, of this number in its row or column, in a range of
  /// pixels that meets it.
  static std::pair<std::uint32_t, std::uint32_t> blocks_of(std::uint32_t first, std::uint32_t last,
                                                           std::uint32_t tile) {
    const std::uint32_t begin = tile * Tile::size;
    return {(std::max(first, begin) - begin) / Tile::block,
            std::min(last - begin, Tile::size - 1) / Tile::block};
  }

  std::array<std::uint64_t, 2> first_blocks_{};
};

/// The triangles of one side in tiles of the window, each once.
class Gathered {
 public:
  Gathered(std::vector<TileEntry>& entries, std::vector<std::uint64_t>& taken,
           std::uint32_t first_number)
      : entries_(entries), taken_(taken), first_number_(first_number) {
    entries_.clear();
  }
  ~Gathered() {
    for (const TileEntry& entry : entries_) word_of(entry) = 0;
  }
  Gathered(const Gathered&) = delete;
  Gathered& operator=(const Gathered&) = delete;

  void add(const std::vector<Bins>& all_bins, std::uint32_t tile, Side side, const BlocksMet& met) {
    for (const Bins& bins : all_bins) {
      for (const TileEntry& entry : bins.in_tile(tile, side)) {
        if (!met.may_hold(entry.nearness)) continue;
        const std::uint64_t bit = std::uint64_t{1} << (entry.number - first_number_) % 64;
        if (word_of(entry) & bit) continue;
        word_of(entry) |= bit;
        entries_.push_back(entry);
      }
    }
  }
  /// Leaves out what is certainly hidden by surfaces that are nowhere farther than a q.
  void leave_out_behind(float farthest) {
    const auto is_hidden = [&](const TileEntry& entry) {
      return std::bit_cast<float>(entry.nearness & nearness_of_q) < farthest;
    };
    for (const TileEntry& entry : entries_)
      if (is_hidden(entry)) word_of(entry) = 0;
    std::erase_if(entries_, is_hidden);
  }

 private:
  std::uint64_t& word_of(const TileEntry& entry) {
    return taken_[(entry.number - first_number_) / 64];
  }

  std::vector<TileEntry>& entries_;
  std::vector<std::uint64_t>& taken_;
  std::uint32_t first_number_;
};

void draw_side(LensTile& tile, Side side, const WindowScene& scene,
               std::vector<std::uint64_t>& taken, const LensContext& context) {
  const DrawContext& window = context.window;
  Gathered gathered(window.visible.entries(), taken, scene.first_number);
  const PixelBox& area = tile.where().area;
  scene.grid.for_each_tile(area, [&](std::uint32_t number) {
    const BlocksMet met(area, number % scene.grid.columns, number / scene.grid.columns);
    gathered.add(scene.bins, number, side, met);
  });
  if (side == Side::back && window.switches.early_rejection)
    gathered.leave_out_behind(tile.farthest());
  window.visible.for_each_part(tile.tile(), false, [&](std::span<const std::uint32_t> numbers) {
    for_each_object(numbers, scene.objects,
                    [&](const ImageObject& object, std::span<const std::uint32_t> of_object) {
                      tile.draw(object, of_object, context);
                    });
  });
}

}  // namespace

ViewDrawing::ViewDrawing(const TriangleSource& triangles, const Camera& camera,
                         const RenderOptions& options, const Places& the_places,
                         const Places::View& the_view, bool keeps_memory)
    : places(the_places),
      view(the_view),
      window(camera, view),
      frame(window.camera, options, keeps_memory),
      rays(triangles, window.camera),
      workers([this, &triangles] { return FastWorker(triangles, window.camera, rays); }),
      sorting_again([this, &triangles] { return FastWorker(triangles, window.camera, rays); }) {
  frame.by_area = true;  // samples lie anywhere in a window's pixels
  frame.range = window.range;
}

PixelBox ViewDrawing::area_of_tile(std::uint32_t tile) const {
  if (view.boxes[tile].is_empty()) return {};
  return TileInWindow(window, {{}, {}, view.errors[tile], view.boxes[tile], true}).area;
}

void ViewDrawing::start(LensTile& lens_tile, Tile& tile, std::uint32_t number,
                        Places::Room& room) const {
  const Places::OfTile of_tile = places.of_tile(view, number, room);
  lens_tile.start(tile, of_tile, TileInWindow(window, of_tile));
}

void draw_lens_tile(LensTile& tile, const WindowScene& scene, std::vector<std::uint64_t>& taken,
                    const LensContext& context) {
  const std::size_t triangles =
      scene.objects.empty() ? 0 : scene.objects.back().end_number() - scene.first_number;
  if (taken.size() * 64 < triangles) taken.resize(triangles / 64 + 1, 0);
  draw_side(tile, Side::front, scene, taken, context);
  tile.begin_back_faces();
  draw_side(tile, Side::back, scene, taken, context);
}

bool is_met(const PixelBox& area, const WindowScene& scene) {
  bool met = false;
  scene.grid.for_each_tile(area,
                           [&](std::uint32_t number) { met = met || is_met(scene.bins, number); });
  return met;
}

void write_valid(const Places& places, const TileGrid& image, std::uint32_t first,
                 std::uint32_t end, const MapLayout& layout, std::uint32_t* valid) {
  if (valid == nullptr) return;
  parallel_for(first, end, [&](std::uint32_t tile) {
    const PixelBox area = image.area(tile);
    for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
      for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
        const std::size_t i = Tile::index(column - area.first_column, row - area.first_row);
        valid[layout.pixel(column, row)] = places.has_ray(tile, i) ? 1 : 0;
      }
    }
  });
}

void add_view(Rendered& rendered, const FastWorkers& workers, const TriangleSource& triangles,
              const Camera& camera) {
  RenderStatistics of_view = sum_of(workers, triangles.count());
  if (rendered.statistics.triangles != 0)
    of_view.triangles = of_view.degenerate_triangles = of_view.culled_triangles = 0;
  add(rendered.statistics, of_view);
  const std::vector<std::uint64_t> doubtful = doubtful_pixels(workers, camera);
  rendered.doubtful.insert(rendered.doubtful.end(), doubtful.begin(), doubtful.end());
}

Rendered write_ray_by_ray(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options, DepthMap map, const Places& places) {
  ChannelWriter writer(map, triangles, camera, options);
  RenderStatistics statistics;
  statistics.triangles = triangles.count();
  FirstFault fault;
  const RayByRay rays(triangles, camera, options.cull, places.preimages());
  std::vector<std::uint32_t> all(triangles.count());
  std::iota(all.begin(), all.end(), 0);
  rays.count(all, statistics);
  rays.write({0, camera.width - 1, 0, camera.height - 1}, {camera.width}, writer, statistics,
             fault);
  if (fault.get()) fail(*fault.get(), map);
  return {std::move(map), statistics, {}};
}

namespace {

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
  return write_ray_by_ray({scene}, camera, options,
                          make_background(camera, options, context, std::move(before)), places);
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
        workers_([&] { return LensWorker(triangles, camera); }),
        outputs_([&] { return LensOutput(writer, {camera.width}); }),
        progress_(context.progress, image_.count() * places.views().size()) {}

  void draw(const Places::View& view);

  /// Without a map.
  [[nodiscard]] const Rendered& counted() const { return counted_; }
  [[nodiscard]] const FirstFault& fault() const { return fault_; }

 private:
  void draw_tile(std::uint32_t number, ViewDrawing& drawing, const WindowScene& scene);

  const TriangleSource& triangles_;
  const Camera& camera_;
  const RenderOptions& options_;
  const RenderContext& context_;
  const Places& places_;
  RenderMemory::Parts& memory_;
  TileGrid image_;
  PerThread<LensWorker> workers_;
  PerThread<LensOutput> outputs_;
  Progress progress_;
  FirstFault fault_;
  Rendered counted_;
};

void LensImage::draw(const Places::View& view) {
  ViewDrawing drawing(triangles_, camera_, options_, places_, view, context_.kept != nullptr);
  const ImageObjects objects =
      image_objects(triangles_, drawing.window.camera, context_.kept ? &memory_.vertices : nullptr);
  memory_.vertices.forget();
  const std::vector<Bins>& bins = memory_.bins =
      sort_into_tiles(objects, 0, static_cast<std::uint32_t>(triangles_.count()), parts_of_scene,
                      drawing.frame, drawing.workers, std::move(memory_.bins));
  const WindowScene scene{objects, bins, drawing.frame.grid, 0};
  parallel_for(std::uint32_t{0}, image_.count(), [&](std::uint32_t number) {
    if (!view.boxes[number].is_empty()) draw_tile(number, drawing, scene);
    progress_.part_done();
  });
  add_view(counted_, drawing.workers, triangles_, camera_);
}

void LensImage::draw_tile(std::uint32_t number, ViewDrawing& drawing, const WindowScene& scene) {
  LensWorker& worker = workers_.local();
  const DrawContext window = drawing.context();
  const LensContext context = drawing.context_of(window, worker);
  worker.samples->start(image_.area(number));
  drawing.start(*worker.tile, *worker.samples, number, *worker.places);
  draw_lens_tile(*worker.tile, scene, worker.taken, context);
  fault_.add(outputs_.local().write(*worker.tile, context));
}

Rendered render_in_windows(const Scene& scene, const Camera& camera, const RenderOptions& options,
                           const RenderContext& context, const Places& places,
                           RenderMemory::Parts& memory, DepthMap before) {
  const TriangleSource triangles(scene);
  DepthMap map = make_background(camera, options, context, std::move(before));
  ChannelWriter writer(map, triangles, camera, options);
  const TileGrid grid(camera.width, camera.height);
  write_valid(places, grid, 0, grid.count(), {camera.width}, writer.values().valid);
  LensImage image(triangles, camera, options, context, places, memory, writer);
  for (const Places::View& view : places.views()) image.draw(view);
  if (image.fault().get()) fail(*image.fault().get(), map);
  return {std::move(map), image.counted().statistics, image.counted().doubtful};
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

namespace {

/// A tile of a lens that waits for further triangles.
struct WaitingTile {
  WaitingTile(const ViewDrawing& drawing, const TileGrid& image, std::uint32_t number) {
    samples.start(image.area(number));
    drawing.start(tile, samples, number, room);
  }

  Places::Room room;
  Tile samples;
  LensTile tile;
};
constexpr std::uint64_t bytes_of_tile = sizeof(WaitingTile) + Tile::most_packed_bytes;

/// What all views share.
struct StreamedImage {
  const TriangleSource& triangles;
  const Camera& camera;
  const RenderOptions& options;
  const StreamLimits& limits;
  const Places& places;
  TileGrid grid;
  PerThread<LensWorker>& workers;
  PerThread<LensOutput>& outputs;
  FirstFault& fault;
};

/// One view of the image.
class StreamedView {
 public:
  StreamedView(const StreamedImage& image, const Places::View& view)
      : image_(image), drawing_(image.triangles, image.camera, image.options, image.places, view) {}

  /// Draws and writes rows [first_row, end_row) of tiles; the first of them counts triangles.
  void draw(std::uint32_t first_row, std::uint32_t end_row) {
    const std::uint32_t first = first_row * image_.grid.columns;
    std::vector<std::unique_ptr<WaitingTile>> tiles((end_row - first_row) * image_.grid.columns);
    image_.triangles.for_each_part(
        image_.limits.triangles_at_once, [&](const TriangleSource::Part& part) {
          draw_part(part, first, tiles, first_row == 0 ? drawing_.workers : drawing_.sorting_again);
        });
    parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      if (!tiles[i]) return;
      const DrawContext context = drawing_.context();
      image_.fault.add(image_.outputs.local().write(
          tiles[i]->tile, drawing_.context_of(context, image_.workers.local())));
    });
  }
  [[nodiscard]] const FastWorkers& workers() const { return drawing_.workers; }

 private:
  void draw_part(const TriangleSource::Part& part, std::uint32_t first,
                 std::vector<std::unique_ptr<WaitingTile>>& tiles, FastWorkers& sorting) {
    ImageObjects objects;
    objects.emplace_back(part.object, part.mesh, drawing_.window.camera, part.first_number);
    const std::vector<Bins> bins =
        sort_into_tiles(objects, part.first_number, objects.front().end_number(), parts_of_chunk,
                        drawing_.frame, sorting);
    const WindowScene scene{objects, bins, drawing_.frame.grid, part.first_number};
    parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      const std::uint32_t number = first + static_cast<std::uint32_t>(i);
      if (drawing_.view.boxes[number].is_empty()) return;
      if (!tiles[i]) tiles[i] = std::make_unique<WaitingTile>(drawing_, image_.grid, number);
      LensTile& tile = tiles[i]->tile;
      if (!is_met(tile.where().area, scene)) return;
      const DrawContext context = drawing_.context();
      LensWorker& worker = image_.workers.local();
      draw_lens_tile(tile, scene, worker.taken, drawing_.context_of(context, worker));
      tile.tile().pack();
    });
  }

  const StreamedImage& image_;
  ViewDrawing drawing_;
};

/// Rows of tiles of a band: as many as fit into the memory, at least one.
std::uint32_t rows_of_band(const TileGrid& grid, const StreamLimits& limits) {
  const std::uint64_t rows = limits.tile_bytes / (bytes_of_tile * grid.columns);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rows, 1, grid.rows));
}

}  // namespace

Rendered render_lens_streamed(const StreamedScene& scene, const Camera& camera,
                              const RenderOptions& options, const StreamLimits& limits,
                              const RenderContext& context) {
  const TriangleSource triangles(scene);
  const Places places(camera.projection, camera.width, camera.height);
  DepthMap map = make_background(camera, options, context);
  if (!places.are_usable())
    return write_ray_by_ray(triangles, camera, options, std::move(map), places);
  ChannelWriter writer(map, triangles, camera, options);
  const TileGrid grid(camera.width, camera.height);
  write_valid(places, grid, 0, grid.count(), {camera.width}, writer.values().valid);
  PerThread<LensWorker> workers([&] { return LensWorker(triangles, camera); });
  PerThread<LensOutput> outputs([&] { return LensOutput(writer, {camera.width}); });
  FirstFault fault;
  const StreamedImage image{triangles, camera,  options, limits, places,
                            grid,      workers, outputs, fault};
  Progress progress(context.progress, grid.rows * places.views().size());
  Rendered rendered;
  for (const Places::View& each : places.views()) {
    StreamedView view(image, each);
    const std::uint32_t rows = rows_of_band(grid, limits);
    for (std::uint32_t row = 0; row < grid.rows; row += rows) {
      const std::uint32_t end = std::min(row + rows, grid.rows);
      view.draw(row, end);
      for (std::uint32_t i = row; i < end; ++i) progress.part_done();
    }
    add_view(rendered, view.workers(), triangles, camera);
  }
  if (fault.get()) fail(*fault.get(), map);
  rendered.map = std::move(map);
  return rendered;
}

}  // namespace fathom::fast
