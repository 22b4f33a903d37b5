#pragma once

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/raster/raster_polygon.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

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

  /// Sets the fragment's value and what is expected without roundings, and lowers its coverage
  /// where the range of window depths may cut it away.
  void set(Fragment& fragment, const RasterPolygon& polygon, double x, double y) const;
  /// The same where nothing is known of where the polygon is seen.
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
  double sign_;  ///< of a window depth in a fragment's value, where the nearer is the less
};

}  // namespace fathom::attribution
