#pragma once

#include <cstdint>
#include <memory>
#include <vector>

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

/// What images of lenses are drawn with, whether their scene is in memory or in files.
namespace fathom::fast {

/// A thread's tools for lenses; those for the window are its FastWorker.
struct LensWorker {
  /// For so many triangles at once.
  LensWorker(const TriangleSource& triangles, const Camera& camera, triangle::ChannelWriter& writer,
             std::uint64_t count)
      : referee(triangles, camera),
        tile(std::make_unique<LensTile>()),
        places(std::make_unique<Places::Room>()),
        output(writer, camera.width),
        taken(count / 64 + 1, 0) {}

  triangle::RayReferee referee;
  std::unique_ptr<LensTile> tile;
  std::unique_ptr<Places::Room> places;
  LensOutput output;
  /// A bit for each triangle: whether it is among those of the tile.
  std::vector<std::uint64_t> taken;
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

/// Writes which pixels have a ray, if `valid` is asked for.
void write_valid(const Places& places, const TileGrid& image, std::uint32_t* valid);

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
