#pragma once

#include "fathom/image/depth_map.h"
#include "fathom/image/pictures/legend.h"

namespace fathom::image {

/// Draws the channel Zfight: the pixels where the wrong surface wins stand out from neutral
/// colours. Few such pixels of a picture that will not be enlarged are drawn as larger squares.
void draw_fights(Sheet& sheet, const DepthMap& map, const ImageChannel& channel, Rgb background);

}  // namespace fathom::image
