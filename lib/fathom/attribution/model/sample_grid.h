#pragma once

#include <array>
#include <cstdint>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/projection.h"

namespace fathom::attribution {

/// Where an ideal lens shows the point that a camera with radial distortion shows at an image
/// point.
///
/// Frame    pixels from the top left corner of the image.
/// Exact    iterated in binary64 until it stands; with k1 = k2 = 0 nothing is changed.
class SampleGrid {
 public:
  SampleGrid(const Camera& camera, const SamplePosition& sample);

  /// Of the pixel's sample; NaN if a lens has no ray there.
  [[nodiscard]] std::array<double, 2> at(std::uint32_t column, std::uint32_t row) const;
  /// How far it may be from where the pixel's sample is, in either direction, in pixels.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  RoundedProjection projection_;
  SamplePosition sample_;
  double reach_ = 0;
};

/// The point of the plane at depth 1 that a lens with distortion shows at (x, y) of that plane.
std::array<double, 2> undistorted(double x, double y, double k1, double k2);

}  // namespace fathom::attribution
