#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/evaluation/surface_distances.h"
#include "fathom/numeric/ratio.h"
#include "fathom/scene/scene.h"

namespace fathom::evaluation {

/// One side of a comparison, a surface or a cloud: the points to measure from, and the distance of
/// any point from it. Thread-safe.
class Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape() = default;

  /// The number of points to measure from.
  [[nodiscard]] virtual std::uint32_t points() const = 0;
  /// The number of the point at a place of an order in which neighbours follow each other, so that
  /// caches still hold the data of the previous point.
  [[nodiscard]] virtual std::uint32_t number_at(std::uint32_t place) const = 0;
  [[nodiscard]] virtual PlacedPoint point(std::uint32_t number) const = 0;
  /// Whether a camera sees the point. `last_camera`, 0 at first, is the camera to ask first:
  /// neighbours are mostly seen by the same one.
  [[nodiscard]] virtual bool is_seen(std::uint32_t number, std::size_t& last_camera) const = 0;
  /// The square of the distance from the nearest point of the shape, exactly; scene units.
  [[nodiscard]] virtual Ratio squared_distance(const PlacedPoint& p) const = 0;
  /// The points of a cloud before it was thinned; 0 for a surface.
  [[nodiscard]] virtual std::uint64_t cloud_points() const = 0;
};

/// The shape of a scene, in units of 2 to the power of `power`. A cloud is thinned to `density`, if
/// there is one. Scene and cameras must outlive the shape.
/// Fails    InputError "NAME: …" where a surface has no area.
std::unique_ptr<const Shape> shape_of(const Scene& scene, const char* name, long power,
                                      const std::vector<Camera>& cameras,
                                      std::optional<double> density,
                                      const SurfaceComparisonOptions& options);

/// How much memory a shape takes, in bytes; `with_sight`: with what cameras see of it.
double bytes_of_shape(const Scene& scene, std::optional<double> density, bool with_sight,
                      const SurfaceComparisonOptions& options);

}  // namespace fathom::evaluation
