#pragma once

#include <limits>

#include "fathom/camera/camera.h"
#include "fathom/geometry/pixel_box.h"

namespace fathom::attribution {

/// A box of the image plane that grows with what it is to hold, in pixels from the top left.
struct ImageBox {
  double least_x = std::numeric_limits<double>::infinity(), least_y = least_x;
  double greatest_x = -least_x, greatest_y = -least_x;

  /// Takes in a point and what is up to `margin_x`, `margin_y` from it.
  void add(double x, double y, double margin_x, double margin_y);
};

/// All pixels of an image.
PixelBox whole_image(const Camera& camera);

/// The pixels that a box meets, `more` pixels wider on each side; none where it misses the image.
PixelBox pixels_of(const ImageBox& box, const Camera& camera, double more);

}  // namespace fathom::attribution
