#pragma once

#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

namespace fathom::studies {

/// A picture as a PNG; each pixel becomes a square of `scale` pixels.
/// Fails    OutputError.
StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale = 1);

}  // namespace fathom::studies
