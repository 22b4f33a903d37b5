#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/renderer_model.h"
#include "fathom/attribution/world_mesh.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::attribution {

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

/// `camera` has finite near and far where the model is a raster model with such a mapping; mesh and
/// camera outlive the source.
std::unique_ptr<FragmentSource> raster_fragments(const WorldMesh& mesh, const Camera& camera,
                                                 const RendererModel& model);
std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const RendererModel& model);
std::unique_ptr<FragmentSource> fragments(const WorldMesh& mesh, const Camera& camera,
                                          const RendererModel& model);

/// The factor by which bounds are enlarged for the binary64 roundings of their own evaluation: each
/// bound is a sum of at least 2⁻²⁴ times magnitudes whose evaluation here, and that of the values
/// that they bound, errs by less than 2⁻⁴⁶ of the same magnitudes.
inline constexpr double own_roundings = 1 + 0x1p-20;

}  // namespace fathom::attribution
