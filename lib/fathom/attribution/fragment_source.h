#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/world_mesh.h"
#include "fathom/camera/camera.h"
#include "fathom/geometry/pixel_box.h"

namespace fathom::attribution {

/// Column and row of a pixel, from the top left, and a fragment there.
using TakeFragment =
    std::function<void(std::uint32_t column, std::uint32_t row, const Fragment& fragment)>;

/// The triangles of a mesh as a renderer of a model sees them. Calls may come from several threads.
class FragmentSource {
 public:
  FragmentSource() = default;
  virtual ~FragmentSource() = default;
  FragmentSource(const FragmentSource&) = delete;
  FragmentSource& operator=(const FragmentSource&) = delete;

  /// Pixels outside which the triangle is never covered.
  [[nodiscard]] virtual PixelBox box(std::uint32_t triangle) const = 0;
  /// Calls `take(column, row, fragment)` for the pixels of `box` whose sample the triangle covers
  /// or may cover.
  virtual void each(std::uint32_t triangle, const PixelBox& box,
                    const TakeFragment& take) const = 0;
};

/// `camera` has finite near and far where a raster model has such a mapping; the mesh outlives the
/// source.
std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model);
std::unique_ptr<FragmentSource> raster_fragments(const WorldMesh& mesh, const Camera& camera,
                                                 const SamplePosition& sample,
                                                 const RasterModel& model);
std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const SamplePosition& sample, const RayModel& model);

}  // namespace fathom::attribution
