#pragma once

#include <array>
#include <vector>

#include "fathom/pipeline/geometry/back_face_culling.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/geometry/window_transform.h"

namespace fathom::pipeline {

/// A triangle as it reaches scan conversion.
template <class Real>
struct WindowTriangle {
  std::uint32_t number = 0;  ///< of the triangle of the scene that it is a part of
  std::array<WindowVertex<Real>, 3> corners;
  bool front = true;  ///< as displayed, by the options' front face
  /// The world corners of the scene's whole triangle, also for a part of it: flat shading uses the
  /// plane of the whole.
  std::array<std::array<Real, 3>, 3> face{};
  Real depth_offset = 0;  ///< polygon offset, added to the window depth of its fragments
  std::uint32_t object = 0;
};

/// An edge of a triangle, or a part of one.
template <class Real>
struct WindowLine {
  std::uint32_t number = 0;
  std::array<WindowVertex<Real>, 2> ends;
  std::uint32_t object = 0;
};

/// A corner of a triangle.
template <class Real>
struct WindowPoint {
  std::uint32_t number = 0;
  WindowVertex<Real> place;
  std::uint32_t object = 0;
};

/// The input of scan conversion. Lines and points come from the files, which are drawn whatever the
/// shading is, and from the edges and corners of unculled triangles, if the shading draws these;
/// they are clipped as lines and points.
template <class Real>
struct WindowPrimitives {
  std::vector<WindowTriangle<Real>> triangles;
  std::vector<WindowLine<Real>> lines;
  std::vector<WindowPoint<Real>> points;
};

/// The corners, snapped to the subpixel grid.
template <class Real>
std::array<GridPoint, 3> snapped(const WindowTriangle<Real>& triangle, int bits);

/// The offset of a triangle's window depth (depth_format/depth_bias.h).
template <class Real>
Real depth_offset(const WindowTriangle<Real>& triangle, Storage storage, const DepthBias& bias);

/// Puts triangles into the order that the options request. The order by depth uses the depth of the
/// mean of a triangle's three corners along the view; equal depths keep the order of the file. It
/// is correct only for small triangles that do not penetrate each other (painters_algorithm.h is
/// correct for more).
template <class Real>
void put_into_draw_order(std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options);

}  // namespace fathom::pipeline
