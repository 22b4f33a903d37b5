#pragma once

#include <array>
#include <optional>

#include "fathom/attribution/model/renderer_camera.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/attribution/world_mesh.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// What the roundings of a matrix that is not known do to window depths. All triangles share them:
/// unlike those of corners and planes they do not cancel, however many triangles there are.
class MatrixRoundings {
 public:
  MatrixRoundings(const Camera& camera, const RasterModel& model, const WorldMesh& mesh);

  /// How far they may move the window depth of a surface at a depth that a pixel shows, of the
  /// rows of z and w. (Those of x and y move the image, by which some surfaces come nearer and
  /// others farther.)
  [[nodiscard]] double of_window(std::size_t pixel, double depth) const;

 private:
  /// Nothing where the matrix is known.
  std::optional<std::array<ClipRow, 4>> rows_;
  CameraRays rays_;
  std::array<double, 3> shift_;
  std::size_t width_;
  double of_entry_;  ///< relative
  double half_;      ///< window depths per z of normalized coordinates
};

}  // namespace fathom::attribution
