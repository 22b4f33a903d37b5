#pragma once

#include <vector>

#include "apps/study/clipping/clipped_shapes.h"
#include "apps/study/study.h"

namespace fathom::studies {

/// The plot shape-NAME: three panels, in which the shape is clipped in the three ways.
std::vector<StudyFile> draw(const ClippedShape& shape);

}  // namespace fathom::studies
