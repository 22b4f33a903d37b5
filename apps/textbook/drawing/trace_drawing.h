#pragma once

#include "apps/textbook/drawing/picture.h"

namespace fathom::app::drawing {

/// A trace of `fathom pipeline trace --json`: the primitive in the window of an image of this size,
/// its fragments if they are listed, the output merger at the pixel, the painter's order.
/// Fails    InputError where there is more than a picture shows.
std::vector<Picture> draw_trace(const Json& trace, std::uint32_t width, std::uint32_t height);

}  // namespace fathom::app::drawing
