#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// One row of the matrix from positions in the world to OpenGL's clip coordinates: value = row·(p,
/// 1), where p is a position minus the model's shift and, if the matrix is known, scaled.
struct ClipRow {
  std::array<double, 4> row{};
  /// The magnitudes to which the renderer's roundings are relative: error <= γ·magnitude·(|p|, 1).
  std::array<double, 4> magnitude{};
  /// Computing the row in binary64, here or in the renderer, lost less than 2⁻⁴⁶ of loss·(|p|, 1).
  std::array<double, 4> loss{};
};

/// The rows of x, y (up), z and w: the rows of the model's matrix, if it is known.
std::array<ClipRow, 4> clip_rows(const Camera& camera, const RasterModel& model);

/// The rows of a part: value = row·(p, 1), where p is a position in its frame minus its shift.
std::array<ClipRow, 4> rows_of_part(const Camera& camera, const RasterModel& model,
                                    const RasterPart& part);

/// The rows of a camera, whether or not the model's matrix is known; without a scale.
std::array<ClipRow, 4> rows_of_camera(const Camera& camera, const RasterModel& model);

/// The model with `shift` set. With shift_as_vtk, the shift is the middle of the box of all points
/// if the middle is more than 1000 of the box's diagonals from the origin, or if the square of the
/// diagonal is above 1000 or below 1/1000; otherwise it is 0. VTK does this with a mesh that a
/// single mapper draws without a transform.
/// Source   vtkOpenGLVertexBufferObject::UpdateShiftScale, AUTO_SHIFT_SCALE.
RasterModel with_known_shift(const RasterModel& model, const WorldMesh& mesh);

/// A corner in clip coordinates (x, y, z, w), −w ≤ x, y ≤ w inside the image, and bounds on the
/// distance of the renderer's own from them. z is w times the window depth, 0 ≤ z ≤ w, whatever
/// OpenGL's own z is.
struct ClipVertex {
  std::array<double, 4> value{}, error{};
  /// Borders of the view volume that it was cut at, one bit each; 0 for a corner of the mesh.
  unsigned borders = 0;
};

/// All points of a mesh, in its order.
std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RasterModel& model);

/// The effect of the roundings of an unknown matrix on window depths. All triangles share these
/// roundings: unlike roundings of corners and planes, they do not cancel, however many triangles
/// there are.
class MatrixRoundings {
 public:
  MatrixRoundings(const Camera& camera, const RasterModel& model, const WorldMesh& mesh);

  /// A bound on the change of the window depth of a surface, at the depth that a pixel shows, from
  /// the roundings of the rows of z and w. (Roundings of the rows of x and y move the image, by
  /// which some surfaces come nearer and others farther.)
  [[nodiscard]] double of_window(std::size_t pixel, double depth) const;

 private:
  /// nullopt if the matrix is known.
  std::optional<std::array<ClipRow, 4>> rows_;
  CameraRays rays_;
  std::array<double, 3> shift_;
  std::size_t width_;
  double of_entry_;  ///< relative
  double half_;      ///< window depths per z of normalized coordinates
};

}  // namespace fathom::attribution
