#pragma once

#include "fathom/pipeline/options.h"
#include "fathom/pipeline/output/output_merger.h"

namespace fathom::pipeline {

/// Fast approximate antialiasing: a pass over the finished picture.
///
/// A pixel whose luma differs little from that of its four neighbours is left as it is. Otherwise
/// an edge runs along one of its sides: horizontal or vertical, by second differences of luma over
/// its eight neighbours, and on the side of the greater step. Both ways along this side, steps of
/// growing length look for where the edge ends: where the mean luma of the two pixels beside it
/// has changed by a quarter of the step. How near the nearer end is, in the length of the edge,
/// says how much of the pixel the smooth edge would leave to its neighbour; that share of the
/// neighbour is mixed in, or more if the pixel sticks out of its surroundings (subpixel).
///
/// It is given the picture alone, so it smooths edges of textures and strokes of letters like edges
/// of surfaces. Beyond the border the picture goes on as its last pixels.
/// Source   [Lot09], in the form of FXAA 3.11 "quality", preset 39 (12 steps, up to 26.5 pixels);
///          luma is 0.299 R + 0.587 G + 0.114 B of the colours as they are.
ColourImage fxaa(const ColourImage& image, const FxaaSettings& settings = {});

}  // namespace fathom::pipeline
