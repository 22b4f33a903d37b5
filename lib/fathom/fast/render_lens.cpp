#include "fathom/fast/render_lens.h"

#include <memory>
#include <utility>

#include "fathom/fast/channels/fast_output.h"
#include "fathom/fast/lens_drawing.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/render_memory_parts.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/rendering/map_of_camera.h"
#include "fathom/scene/element_checks.h"
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
        workers_([&] { return LensWorker(triangles, camera, writer, triangles.count()); }),
        progress_(context.progress, image_.count() * places.views().size()) {}

  void draw(const Places::View& view);

  /// Without a map.
  [[nodiscard]] const Rendered& counted() const { return counted_; }
  [[nodiscard]] const FirstFault& fault() const { return fault_; }

 private:
  void draw_tile(std::uint32_t number, const Places::View& view, const Window& window,
                 const WindowScene& scene, const DrawContext& context);

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
  Rendered counted_;
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
  const WindowScene scene{objects, bins, frame.grid, 0};
  parallel_for(std::uint32_t{0}, image_.count(), [&](std::uint32_t number) {
    if (!view.boxes[number].is_empty())
      draw_tile(number, view, window, scene, frame.context(workers.local()));
    progress_.part_done();
  });
  add_view(counted_, workers, triangles_, camera_);
}

void LensImage::draw_tile(std::uint32_t number, const Places::View& view, const Window& window,
                          const WindowScene& scene, const DrawContext& context) {
  LensWorker& worker = workers_.local();
  const LensContext lens{context, worker.referee, places_.preimages(), window.axes};
  const Places::OfTile of_tile = places_.of_tile(view, number, *worker.places);
  LensTile& tile = *worker.tile;
  tile.start(image_.area(number), of_tile, TileInWindow(window, of_tile));
  draw_lens_tile(tile, scene, worker.taken, lens);
  fault_.add(worker.output.write(tile, lens));
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

}  // namespace fathom::fast
