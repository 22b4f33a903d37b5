#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/lenses/lens_output.h"
#include "fathom/fast/lenses/lens_tile.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/render_fast.h"
#include "fathom/fast/render_memory.h"
#include "fathom/fast/stream.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/rendering/rendered.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/referee.h"

/// What images of lenses are drawn with, wherever their scenes are.
namespace fathom::fast {

/// A thread's tools for lenses; those for the window are its FastWorker.
struct LensWorker {
  LensWorker(const TriangleSource& triangles, const Camera& camera)
      : referee(triangles, camera),
        samples(std::make_unique<Tile>()),
        tile(std::make_unique<LensTile>()),
        places(std::make_unique<Places::Room>()) {}

  triangle::RayReferee referee;
  std::unique_ptr<Tile> samples;
  std::unique_ptr<LensTile> tile;
  std::unique_ptr<Places::Room> places;
  /// A bit for each triangle: whether it is among those of the tile.
  std::vector<std::uint64_t> taken;
};

/// What all threads draw one view of a lens with.
struct ViewDrawing {
  ViewDrawing(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
              const Places& places, const Places::View& view, bool keeps_memory = false);

  /// The pixels of the window in which the samples of a tile of the image lie; nothing if the view
  /// holds none of them.
  [[nodiscard]] PixelBox area_of_tile(std::uint32_t tile) const;
  [[nodiscard]] DrawContext context() { return frame.context(workers.local()); }
  [[nodiscard]] LensContext context_of(const DrawContext& context_of_window,
                                       LensWorker& worker) const {
    return {context_of_window, worker.referee, places.preimages(),
            window.axes,       window.camera,  rays};
  }
  /// Has a tile of the image, which is empty or has been drawn into, drawn in this view. The places
  /// are valid as long as the room is not used again.
  void start(LensTile& lens_tile, Tile& tile, std::uint32_t number, Places::Room& room) const;

  const Places& places;
  const Places::View& view;
  Window window;
  FastFrame frame;
  triangle::SceneRays rays;
  /// Those of the second sort triangles again, which their statistics would count twice.
  FastWorkers workers, sorting_again;
};

/// Triangles in the window, for all threads; the least of their numbers is `first_number`, or more.
struct WindowScene {
  const ImageObjects& objects;
  const std::vector<Bins>& bins;
  const TileGrid& grid;
  std::uint32_t first_number;
};

/// Draws in a tile the triangles that meet its area of the window. `taken` has a bit for each,
/// counted from the first; all are 0 before and after.
void draw_lens_tile(LensTile& tile, const WindowScene& scene, std::vector<std::uint64_t>& taken,
                    const LensContext& context);

/// Whether a triangle may meet an area of the window.
bool is_met(const PixelBox& area, const WindowScene& scene);

/// Writes which pixels of the tiles first ≤ tile < end have a ray, if `valid` is asked for.
void write_valid(const Places& places, const TileGrid& image, std::uint32_t first,
                 std::uint32_t end, const MapLayout& layout, std::uint32_t* valid);

/// Adds the statistics and the doubtful pixels of a view. Triangles are counted in the first view
/// only: they are the same in each.
void add_view(Rendered& rendered, const FastWorkers& workers, const TriangleSource& triangles,
              const Camera& camera);

/// An image that no window holds, in a map that has its background.
Rendered write_ray_by_ray(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options, DepthMap map, const Places& places);

/// render_fast() for a camera with a lens whose rays all go forwards. In a window where edges are
/// straight, triangles are sorted and set up as without a lens; samples lie where their rays meet
/// it.
Rendered render_lens(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context, RenderMemory::Parts& memory, DepthMap before);

/// render_streamed() for a camera whose lens bends rays: the map of render_fast(), bit for bit. The
/// files are read for each view of the lens, and for each band of rows whose tiles fit into the
/// memory.
Rendered render_lens_streamed(const StreamedScene& scene, const Camera& camera,
                              const RenderOptions& options, const StreamLimits& limits,
                              const RenderContext& context);

}  // namespace fathom::fast
