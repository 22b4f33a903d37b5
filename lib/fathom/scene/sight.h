#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "fathom/camera/camera.h"
#include "fathom/camera/projection.h"
#include "fathom/mesh/mesh.h"
#include "fathom/scene/scene.h"

/// Visibility of a scene's corners, and whether a point is inside a mesh, in binary64: good for a
/// warning, not for a decision about a pixel. Only for .cpp files of this module.
namespace fathom::scene {

using Vector = std::array<double, 3>;

/// An affine map of a point.
Vector applied(const Pose& map, const Vector& X);

/// An object's transform, each entry rounded.
Pose rounded_placement(const Object& object);

/// Counts of points by their visibility for a camera.
struct Sight {
  std::uint64_t points = 0, in_front = 0, in_image = 0;
  /// The box of all points in the world.
  Vector lower, upper;
  double least_depth, greatest_depth;
  /// The box of the images of those in front.
  std::array<double, 2> first, last;

  Sight();
  [[nodiscard]] Vector middle() const;
};

/// A camera with another pose, for the scene scaled by `scale` about the world's origin.
class ApproximateCamera {
 public:
  ApproximateCamera(const Camera& camera, const Pose& pose, double scale = 1);

  [[nodiscard]] Vector camera_point(const Vector& X) const;
  /// How far from the middle of the image a point is seen: 1 at its sides; infinite behind.
  [[nodiscard]] double distance_from_middle(const Vector& X) const;
  /// Counts the corners of every `step`-th triangle. A mesh of two vertices is the outline of a
  /// streamed mesh: the corners of its box count.
  [[nodiscard]] Sight sight_of(const Scene& scene, std::size_t step = 1) const;

 private:
  void look_at(const Vector& X, Sight& sight) const;

  const Camera& camera_;
  Pose pose_;
  RoundedProjection projection_;
  double scale_;
};

/// How often the surface turns around `eye`, a point in the mesh's frame: 1 inside a closed surface
/// whose triangles are counter-clockwise seen from outside, −1 where they are so seen from inside,
/// 0 outside; a fraction where the surface is open.
/// Source   the sum of signed solid angles, by the formula of van Oosterom and Strackee
///          (tan(Ω/2) = det(a, b, c) / (|a||b||c| + …)), over 4π.
double winding_number(const Mesh& mesh, const std::array<double, 3>& eye);

/// Number of triangles through which the ray from `eye` along +x leaves, minus the number through
/// which it enters: the winding number of a closed surface, computed cheaply from one ray.
/// Fails    ElementFault if a triangle has a corner beyond the vertices.
int crossings_along_x(const Mesh& mesh, const std::array<double, 3>& eye);

}  // namespace fathom::scene
