#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// The same camera without its lens.
Camera without_lens(Camera camera);

/// Where the samples of a camera with a lens lie in the image of the camera without it: an image
/// point of that one sees the same ray.
///
/// Frame    pixels from the top left corner of the image.
/// Exact    rounded to binary64 a few times.
class LensSamples {
 public:
  /// Samples lie at these places, or at the centres of the pixels there, as if the image of the
  /// camera without the lens had been looked up: an image of the same size, or one without end.
  enum class Places { as_they_are, at_pixel_centres, at_centres_of_endless };

  /// `x`, `y`: the sample within its pixel.
  /// Fails    UsageError for a lens with rays that do not go forwards, or whose near and far limit
  ///          ray distances; or for a table, if the samples are not the centres.
  LensSamples(const Camera& camera, double x, double y, Places places = Places::as_they_are);

  /// Samples lie at given points, row by row; both NaN for a pixel without a ray.
  LensSamples(const Camera& camera, std::vector<std::array<double, 2>> points);

  /// Both NaN if the pixel has no ray.
  [[nodiscard]] const std::array<double, 2>& at(std::uint32_t column, std::uint32_t row) const {
    return points_[std::size_t{row} * camera_.width + column];
  }
  /// Pixels outside which no sample lies in a box.
  [[nodiscard]] PixelBox pixels_of(const ImageBox& box) const;
  /// With the lens.
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  void find_boxes();

  Camera camera_;
  std::vector<std::array<double, 2>> points_;
  PixelSquares squares_;
  /// Around the samples of each square of pixels.
  std::vector<ImageBox> boxes_;
};

}  // namespace fathom::attribution
