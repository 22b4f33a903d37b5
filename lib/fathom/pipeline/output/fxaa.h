#pragma once

#include "fathom/pipeline/options.h"
#include "fathom/pipeline/output/output_merger.h"

namespace fathom::pipeline {

/// Fast approximate antialiasing: a pass over the finished picture.
///
/// A pixel whose luma differs little from the luma of its four neighbours remains unchanged.
/// Otherwise an edge runs along one of its sides: horizontal or vertical, by second differences of
/// luma over its eight neighbours, and on the side of the greater step. Both ways along this side,
/// steps of growing length search the end of the edge: the place where the mean luma of the two
/// pixels next to it has changed by a quarter of the step. The distance of the nearer end, relative
/// to the length of the edge, gives the share of the pixel that a smooth edge would leave to its
/// neighbour. This share of the neighbour is mixed in, or more if the pixel differs from its
/// surroundings (subpixel).
///
/// FXAA has only the picture, so it smooths edges of textures and strokes of letters like edges of
/// surfaces. Beyond the border the picture repeats its last pixels.
/// Source   [Lot09], in the form of FXAA 3.11 "quality", preset 39 (12 steps, up to 26.5 pixels);
///          luma is 0.299 R + 0.587 G + 0.114 B of the unchanged colours.
ColourImage fxaa(const ColourImage& image, const FxaaSettings& settings = {});

}  // namespace fathom::pipeline
