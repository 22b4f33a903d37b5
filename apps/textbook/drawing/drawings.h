#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/textbook/drawing/picture.h"

namespace fathom::app::drawing {

/// The steps of a case of `fathom clip`, from its answer with --trace: the segment after each
/// split, the ordered parameters, the polygon after each edge or plane, both lists and the walks.
/// Fails    InputError for a case that has no steps, or more than a picture shows.
Picture draw_clip(const std::string& algorithm, const Json& object, const Json& answer);

/// The steps of a case of `fathom scan`, from its answer with --trace: decision values along a
/// line, crossings and spans of each scan line, edge functions at each pixel; of edge-values, the
/// values over the image with their signs.
/// Fails    InputError where there are more pixels than a picture shows.
Picture draw_scan(const std::string& algorithm, const Json& object, const Json& answer);

/// A trace of `fathom pipeline trace --json`: the primitive in the window of an image of this size,
/// its fragments if they are listed, the output merger at the pixel, the painter's order.
/// Fails    InputError where there is more than a picture shows.
std::vector<Picture> draw_trace(const Json& trace, std::uint32_t width, std::uint32_t height);

}  // namespace fathom::app::drawing
