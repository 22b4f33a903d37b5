#include "fathom/fast/stream_lens.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "fathom/fast/channels/fast_output.h"
#include "fathom/fast/lens_drawing.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/rendering/map_of_camera.h"
#include "fathom/threads/threads.h"

// How to read this file: StreamedView::draw() is the whole story. It does with some triangles at a
// time what LensImage (render_lens.cpp) does with all; the tiles of a band keep what is visible so
// far.
namespace fathom::fast {
using namespace rendering;
using namespace triangle;

namespace {

constexpr std::uint32_t parts_of_chunk = 8;

/// A tile of a lens that waits for further triangles.
struct WaitingTile {
  WaitingTile(const Window& window, const Places& places, const Places::View& view,
              const TileGrid& image, std::uint32_t number) {
    const Places::OfTile of_tile = places.of_tile(view, number, room);
    tile.start(image.area(number), of_tile, TileInWindow(window, of_tile));
  }

  Places::Room room;
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
  FirstFault& fault;
};

/// One view of the image.
class StreamedView {
 public:
  StreamedView(const StreamedImage& image, const Places::View& view)
      : image_(image),
        view_(view),
        window_(image.camera, view),
        frame_(window_.camera, image.options),
        rays_(image.triangles, window_.camera),
        workers_([this] { return FastWorker(image_.triangles, window_.camera, rays_); }),
        sorting_again_([this] { return FastWorker(image_.triangles, window_.camera, rays_); }) {
    frame_.by_area = true;  // samples lie anywhere in a window's pixels
    frame_.range = window_.range;
  }

  /// Draws and writes rows [first_row, end_row) of tiles; the first of them counts triangles.
  void draw(std::uint32_t first_row, std::uint32_t end_row) {
    const std::uint32_t first = first_row * image_.grid.columns;
    std::vector<std::unique_ptr<WaitingTile>> tiles((end_row - first_row) * image_.grid.columns);
    image_.triangles.for_each_part(
        image_.limits.triangles_at_once, [&](const TriangleSource::Part& part) {
          draw_part(part, first, tiles, first_row == 0 ? workers_ : sorting_again_);
        });
    parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      if (!tiles[i]) return;
      const DrawContext context = frame_.context(workers_.local());
      image_.fault.add(image_.workers.local().output.write(tiles[i]->tile, lens_of(context)));
    });
  }
  [[nodiscard]] const FastWorkers& workers() const { return workers_; }

 private:
  [[nodiscard]] LensContext lens_of(const DrawContext& context) const {
    return {context, image_.workers.local().referee, image_.places.preimages(), window_.axes};
  }

  void draw_part(const TriangleSource::Part& part, std::uint32_t first,
                 std::vector<std::unique_ptr<WaitingTile>>& tiles, FastWorkers& sorting) {
    ImageObjects objects;
    objects.emplace_back(part.object, part.mesh, window_.camera, part.first_number);
    const std::vector<Bins> bins = sort_into_tiles(
        objects, part.first_number, objects.front().end_number(), parts_of_chunk, frame_, sorting);
    const WindowScene scene{objects, bins, frame_.grid, part.first_number};
    parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      const std::uint32_t number = first + static_cast<std::uint32_t>(i);
      if (view_.boxes[number].is_empty()) return;
      if (!tiles[i])
        tiles[i] =
            std::make_unique<WaitingTile>(window_, image_.places, view_, image_.grid, number);
      LensTile& tile = tiles[i]->tile;
      if (!is_met(tile.where().area, scene)) return;
      const DrawContext context = frame_.context(workers_.local());
      draw_lens_tile(tile, scene, image_.workers.local().taken, lens_of(context));
      tile.tile().pack();
    });
  }

  const StreamedImage& image_;
  const Places::View& view_;
  Window window_;
  FastFrame frame_;
  SceneRays rays_;
  /// Those of the second sort triangles again, which their statistics would count twice.
  FastWorkers workers_, sorting_again_;
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
  write_valid(places, grid, writer.values().valid);
  PerThread<LensWorker> workers(
      [&] { return LensWorker(triangles, camera, writer, limits.triangles_at_once); });
  FirstFault fault;
  const StreamedImage image{triangles, camera, options, limits, places, grid, workers, fault};
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
