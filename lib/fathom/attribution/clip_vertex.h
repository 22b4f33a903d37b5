#pragma once

#include <array>
#include <vector>

#include "fathom/attribution/renderer_model.h"
#include "fathom/attribution/world_mesh.h"

namespace fathom::attribution {

/// The matrix from held positions, (position − shift)·scale, to clip coordinates as OpenGL has
/// them, row by row; made in binary64, each entry rounded to binary32.
std::array<float, 16> clip_from_held(const Camera& camera, const RendererModel& model);

/// A corner in clip coordinates (x, y, z, w), −w ≤ x, y ≤ w inside the image, and how far the
/// renderer's own may be from them. z is w times the window depth, 0 ≤ z ≤ w, whatever OpenGL's
/// own z is.
struct ClipVertex {
  std::array<double, 4> value{}, error{};
  /// Borders of the view volume that it was cut at, one bit each; 0 for a corner of the mesh.
  unsigned borders = 0;
};

/// All corners of a mesh.
std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RendererModel& model);

/// The part of a polygon inside the near plane and, where `at_border`, inside the image and the far
/// plane: Sutherland and Hodgman (1974) on homogeneous coordinates.
std::vector<ClipVertex> cut(const std::array<const ClipVertex*, 3>& triangle, bool at_border);

/// Whether all corners lie beyond one border of the view volume, whatever their errors are.
bool is_certainly_outside(const std::array<const ClipVertex*, 3>& triangle);

/// A corner in window coordinates: x, y in pixels from the top left, z the window depth; q is what
/// a fragment shader makes its own depth of, and `depth` what z means.
struct WindowVertex {
  double x = 0, y = 0, z = 0, q = 0, depth = 0;
  /// Of the renderer's own before and after it is snapped, in either direction.
  double error_x = 0, error_y = 0, error_z = 0, error_q = 0, snapped_x = 0, snapped_y = 0;
  unsigned borders = 0;
};

WindowVertex to_window(const ClipVertex& vertex, const Camera& camera, const RendererModel& model);

}  // namespace fathom::attribution
