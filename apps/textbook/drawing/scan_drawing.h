#pragma once

#include "apps/textbook/drawing/picture.h"

namespace fathom::app::drawing {

/// The steps of a case of `fathom scan`, from its answer with --trace: decision values along a line,
/// crossings and spans of each scan line, edge functions at each pixel; of edge-values, the values
/// over the image with their signs.
/// Fails    InputError where there are more pixels than a picture shows.
Picture draw_scan(const std::string& algorithm, const Json& object, const Json& answer);

}  // namespace fathom::app::drawing
