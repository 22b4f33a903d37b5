#pragma once

#include <functional>

#include "fathom/camera/camera.h"

namespace fathom {

/// The type to which directions are rounded.
enum class DirectionRounding { binary64, binary32 };

/// The directions that the pixels of a camera see, as a table. Each direction is scaled so that its
/// greatest component in magnitude is 1 or −1; then each component is rounded, once. 0, 0, 0 where
/// a pixel has no ray. A table of the camera's own directions may lack their last bits.
/// `progress` is called from 0 to 1 meanwhile.
/// Fails    InputError for an invalid camera, UsageError for an orthographic one, whose rays have
///          one direction and many origins.
DirectionTable directions_of(const Camera& camera,
                             DirectionRounding rounding = DirectionRounding::binary64,
                             const std::function<void(double)>& progress = {});

}  // namespace fathom
