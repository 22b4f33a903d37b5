#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "fathom/fast/image_in_rounds.h"
#include "fathom/fast/lenses/lens_output.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/render_lens.h"
#include "fathom/fast/rounds/tile_store.h"
#include "fathom/rendering/map_background.h"
#include "fathom/threads/threads.h"

// How to read this file: WindowImage does what StraightImage (some_tiles.cpp) does, in each view of
// the lens. A tile of the image draws the triangles of those tiles of a window in which its samples
// lie (render_lens.h). RayImage is an image that no window holds.
namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

using Limits = TilesInRounds::Limits;

/// The tiles of an image as far as a view holds them.
struct ViewInRounds {
  ViewInRounds(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
               const Places& places, const Places::View& view, const TileGrid& image,
               std::uint64_t tile_bytes)
      : drawing(triangles, camera, options, places, view),
        tiles(image, tile_bytes, SamplesLie::anywhere) {
    for (std::uint32_t tile = 0; tile < image.count(); ++tile)
      areas.push_back(drawing.area_of_tile(tile));
  }

  /// A tile as it was left.
  LensTile& take(std::uint32_t tile, LensWorker& worker) {
    drawing.start(*worker.tile, tiles.take(tile), tile, *worker.places);
    return *worker.tile;
  }

  ViewDrawing drawing;
  /// By the tiles of the image, the pixels of the window in which their samples lie.
  std::vector<PixelBox> areas;
  TileStore tiles;
};

class WindowImage : public ImageInRounds {
 public:
  WindowImage(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
              const Limits& limits, std::unique_ptr<const Places> places)
      : triangles_(triangles),
        options_(options),
        camera_(camera),
        places_(std::move(places)),
        image_(camera.width, camera.height),
        workers_([this] { return LensWorker(triangles_, camera_); }) {
    const std::uint64_t tile_bytes = limits.tile_bytes / places_->views().size();
    for (const Places::View& view : places_->views())
      views_.emplace_back(triangles, camera, options, *places_, view, image_, tile_bytes);
  }

  [[nodiscard]] std::uint32_t view_count() const override {
    return static_cast<std::uint32_t>(views_.size());
  }
  SortedViews sort(const std::vector<SomeTriangles>& lists, Counted counted) override;
  void choose(std::vector<std::uint32_t> tiles) override { chosen_ = std::move(tiles); }
  void draw(const SortedViews& views) override;
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row) override;
  [[nodiscard]] RenderStatistics statistics() const override;

 private:
  void draw(const SortedView& sorted, ViewInRounds& view);

  const TriangleSource& triangles_;
  const RenderOptions& options_;
  const Camera& camera_;
  std::unique_ptr<const Places> places_;
  TileGrid image_;
  PerThread<LensWorker> workers_;
  std::deque<ViewInRounds> views_;
  std::vector<std::uint32_t> chosen_;
};

SortedViews WindowImage::sort(const std::vector<SomeTriangles>& lists, Counted counted) {
  SortedViews sorted;
  for (ViewInRounds& view : views_) {
    FastWorkers& workers =
        counted == Counted::here ? view.drawing.workers : view.drawing.sorting_again;
    sorted.push_back(sort_round(lists, triangles_, view.drawing.frame, workers));
    sorted.back().areas = &view.areas;
  }
  return sorted;
}

void WindowImage::draw(const SortedViews& views) {
  for (std::size_t i = 0; i < views.size(); ++i) draw(views[i], views_[i]);
}

void WindowImage::draw(const SortedView& sorted, ViewInRounds& view) {
  const WindowScene scene{sorted.objects, sorted.bins, sorted.grid, 0};
  std::vector<std::uint32_t> met;
  for (const std::uint32_t tile : chosen_)
    if (is_met(view.areas[tile], scene)) met.push_back(tile);
  const std::size_t at_once = view.tiles.most_at_once();
  for (std::size_t first = 0; first < met.size(); first += at_once) {
    parallel_for(first, std::min(first + at_once, met.size()), [&](std::size_t i) {
      LensWorker& worker = workers_.local();
      const DrawContext window = view.drawing.context();
      draw_lens_tile(view.take(met[i], worker), scene, worker.taken,
                     view.drawing.context_of(window, worker));
    });
    view.tiles.make_room();
  }
}

DepthMap WindowImage::rows(std::uint32_t first_row, std::uint32_t end_row) {
  const RowsOfTiles part(camera_, image_, first_row, end_row);
  DepthMap map = make_background(part.camera, options_);
  ChannelWriter writer(map, triangles_, camera_, options_);
  write_valid(*places_, image_, part.first_tile, part.end_tile, part.layout, writer.values().valid);
  PerThread<LensOutput> outputs([&] { return LensOutput(writer, part.layout); });
  FirstFault fault;
  parallel_for(part.first_tile, part.end_tile, [&](std::uint32_t tile) {
    for (ViewInRounds& view : views_) {
      if (!view.tiles.exists(tile)) continue;
      LensWorker& worker = workers_.local();
      const DrawContext window = view.drawing.context();
      fault.add(
          outputs.local().write(view.take(tile, worker), view.drawing.context_of(window, worker)));
      view.tiles.forget(tile);
    }
  });
  part.require_no_fault(fault, map);
  return map;
}

RenderStatistics WindowImage::statistics() const {
  Rendered sum;
  for (const ViewInRounds& view : views_) add_view(sum, view.drawing.workers, triangles_, camera_);
  return sum.statistics;
}

/// Needs no triangles in rounds: each pixel looks at all triangles of the scene.
class RayImage : public ImageInRounds {
 public:
  RayImage(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
           std::unique_ptr<const Places> places)
      : triangles_(triangles),
        options_(options),
        camera_(camera),
        places_(std::move(places)),
        image_(camera.width, camera.height),
        rays_(triangles, camera, options.cull, places_->preimages()) {
    statistics_.triangles = triangles.count();
  }

  [[nodiscard]] std::uint32_t view_count() const override { return 1; }
  SortedViews sort(const std::vector<SomeTriangles>& lists, Counted counted) override {
    if (counted == Counted::here)
      for (const SomeTriangles& list : lists) rays_.count(list.numbers, statistics_);
    return {};
  }
  void choose(std::vector<std::uint32_t> tiles) override { chosen_ = std::move(tiles); }
  void draw(const SortedViews&) override {}
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row) override {
    const RowsOfTiles part(camera_, image_, first_row, end_row);
    DepthMap map = make_background(part.camera, options_);
    ChannelWriter writer(map, triangles_, camera_, options_);
    FirstFault fault;
    for (const std::uint32_t tile : chosen_) {
      if (tile < part.first_tile || tile >= part.end_tile) continue;
      rays_.write(image_.area(tile), part.layout, writer, statistics_, fault);
    }
    part.require_no_fault(fault, map);
    return map;
  }
  [[nodiscard]] RenderStatistics statistics() const override { return statistics_; }

 private:
  const TriangleSource& triangles_;
  const RenderOptions& options_;
  const Camera& camera_;
  std::unique_ptr<const Places> places_;
  TileGrid image_;
  RayByRay rays_;
  RenderStatistics statistics_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace

std::unique_ptr<ImageInRounds> lens_image(const TriangleSource& triangles, const Camera& camera,
                                          const RenderOptions& options, const Limits& limits) {
  auto places = std::make_unique<const Places>(camera.projection, camera.width, camera.height);
  if (!places->are_usable())
    return std::make_unique<RayImage>(triangles, camera, options, std::move(places));
  return std::make_unique<WindowImage>(triangles, camera, options, limits, std::move(places));
}

}  // namespace fathom::fast
