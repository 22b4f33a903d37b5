#pragma once

#include "fathom/pipeline/output_merger.h"

namespace fathom::pipeline {

/// Fast approximate antialiasing: a pass over the finished picture. Where the luma of a pixel's
/// diagonal neighbours differs enough, the picture is blurred along the edge that they suggest. It
/// sees the picture only, so it blurs edges of textures as it does edges of surfaces.
/// Source   T. Lottes, FXAA, NVIDIA 2009; the short form that looks at five pixels, twice or four
///          times along the edge.
ColourImage fxaa(const ColourImage& image);

}  // namespace fathom::pipeline
