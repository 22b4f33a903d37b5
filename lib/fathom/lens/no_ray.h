#pragma once

#include <cstdint>
#include <string>

#include "fathom/camera/projection.h"

namespace fathom::lens {

/// Why a pixel of a camera with a lens has no ray, in a few words: "the lens folds nearer to its
/// axis".
/// Needs    a valid projection with a lens, and a pixel of which Preimages::of_pixel() finds no
///          direction.
/// Cost     as to make Preimages.
std::string why_no_ray(const Projection& projection, std::uint32_t column, std::uint32_t row);

}  // namespace fathom::lens
