#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Where points of triangles are in the image as objects move.
namespace fathom::pipeline {

/// The corners of a triangle as homogeneous image points (U, V, W), in binary64: their places are
/// (U/W, V/W) in pixels where W > 0.
using ImageTriangle = std::array<std::array<double, 3>, 3>;

/// Triangles of one scene, by number, as a camera sees them.
class ImageTriangles {
 public:
  ImageTriangles(const Scene& scene, const Camera& camera);
  [[nodiscard]] ImageTriangle operator[](std::uint32_t number) const;

 private:
  /// Image from mesh, 3 × 4, for each object.
  std::vector<std::array<std::array<double, 4>, 3>> image_from_mesh_;
  std::vector<std::uint32_t> first_;  ///< number of each object's first triangle, and of all
  const Scene* scene_;
};

/// The point of a triangle that is seen at a place of the image, as weights of its corners that add
/// up to 1; nothing if the triangle is seen edge on.
std::optional<std::array<double, 3>> weights_at(const ImageTriangle& triangle, double u, double v);

/// The place of such a point; nothing if it is not in front of the eye.
std::optional<std::array<double, 2>> place_of(const ImageTriangle& triangle,
                                              const std::array<double, 3>& weights);

}  // namespace fathom::pipeline
