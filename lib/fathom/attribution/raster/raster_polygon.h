#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/attribution/raster/depth_plane.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// The part of a polygon inside the near plane and, where `at_border`, inside the image and the far
/// plane: Sutherland and Hodgman's algorithm [SH74] on homogeneous coordinates.
std::vector<ClipVertex> cut(const std::array<const ClipVertex*, 3>& triangle, bool at_border);

/// Whether all corners lie beyond one border of the view volume, whatever their errors are.
bool is_certainly_outside(const std::array<const ClipVertex*, 3>& triangle);

/// Whether all of the triangle lies inside the view volume whatever its errors are, so that nothing
/// is cut.
bool is_certainly_inside(const std::array<const ClipVertex*, 3>& triangle);

/// A triangle in the image as a rasterizer may have cut it, with the interpolated quantities.
struct RasterPolygon {
  std::vector<WindowVertex> corners;
  /// The plane of the window depth; the plane of the quantity from which a fragment shader computes
  /// the depth that it writes, if it does.
  DepthPlane plane, q;
  /// The plane of depths, for a renderer that interpolates depths linearly.
  DepthPlane linear;
  /// The corners run clockwise, seen with y down.
  bool turned = false;
  /// Whether a corner may lie in the plane of the eye, so that its position in the image is
  /// unknown.
  bool anywhere = false;
};

/// All ways in which a renderer of the model may cut a triangle, whatever its roundings are: none
/// if the triangle is certainly invisible, otherwise one or two.
class RasterPolygons {
 public:
  RasterPolygons(const Camera& camera, const RasterModel& model)
      : camera_(camera),
        model_(model),
        window_(window_depth(camera.projection.model, model.mapping, camera.near, camera.far)) {}

  [[nodiscard]] std::vector<RasterPolygon> of(
      const std::array<const ClipVertex*, 3>& triangle) const;
  /// The same without planes: where a triangle may be seen.
  [[nodiscard]] std::vector<RasterPolygon> outlines_of(
      const std::array<const ClipVertex*, 3>& triangle) const;

 private:
  [[nodiscard]] std::optional<RasterPolygon> outline(
      const std::array<const ClipVertex*, 3>& triangle, bool at_border) const;
  void set_planes(RasterPolygon& polygon) const;

  Camera camera_;
  RasterModel model_;
  WindowDepth window_;  ///< of the interpolated depth
};

/// The window depths that a rasterizer may store for a polygon at a sample (docs/validation.md,
/// "Window depth" and "Depths that a fragment shader writes").
///
/// Frame    samples in pixels from the top left corner of the image.
class RasterDepth {
 public:
  /// `sample_error` of the model, in pixels.
  RasterDepth(const Camera& camera, const RasterModel& model, double sample_error)
      : model_(model),
        sample_error_(sample_error),
        stored_(
            window_depth(camera.projection.model, model.stored_mapping(), camera.near, camera.far)),
        sign_(stored_.reversed() ? -1 : 1) {}

  /// Sets the fragment's value and its expectation without roundings, and lowers its coverage if
  /// the range of window depths may cut it away.
  void set(Fragment& fragment, const RasterPolygon& polygon, double x, double y) const;
  /// The same if the position of the polygon is unknown.
  void set_anything(Fragment& fragment) const;

 private:
  [[nodiscard]] double error_of(const DepthPlane& plane) const;
  [[nodiscard]] double expected(const RasterPolygon& polygon, double x, double y) const;
  [[nodiscard]] Interval around(double z, const RasterPolygon& polygon, double x, double y) const;
  [[nodiscard]] Coverage in_range(const RasterPolygon& polygon, double x, double y) const;
  [[nodiscard]] double storage_error(double z) const;
  [[nodiscard]] Interval nearer_is_less(const Interval& window) const;

  RasterModel model_;
  double sample_error_;
  WindowDepth stored_;
  double sign_;  ///< of a window depth in a fragment's value, where smaller is nearer
};

}  // namespace fathom::attribution
