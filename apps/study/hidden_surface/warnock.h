#pragma once

#include "apps/study/hidden_surface/sight.h"

namespace fathom::studies {

/// Hidden surfaces by subdivision of the image: a window is simple if no polygon reaches into it,
/// or if one surrounds it and is nearer than all others at its corners; else its quarters are
/// looked at, down to single pixels, where the nearest polygon at the centre wins.
/// Source   [War69]
Sight warnock(const Scene& scene, const Camera& camera);

}  // namespace fathom::studies
