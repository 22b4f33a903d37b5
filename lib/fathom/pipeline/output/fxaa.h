#pragma once

#include "fathom/pipeline/output/output_merger.h"

namespace fathom::pipeline {

/// Fast approximate antialiasing: a pass over the finished picture. Where the luma of a pixel's
/// diagonal neighbours differs enough, the picture is blurred along the edge that they suggest. It
/// sees only the picture, so it blurs edges of textures as well as edges of surfaces.
/// Source   [Lot09]; the short form, which looks at five pixels and two or four times along the
///          edge.
ColourImage fxaa(const ColourImage& image);

}  // namespace fathom::pipeline
