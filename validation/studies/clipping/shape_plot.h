#pragma once

#include <vector>

#include "validation/studies/clipping/clipped_shapes.h"
#include "validation/studies/study.h"

namespace fathom::studies {

/// The plot shape-NAME: three panels, in which the shape is clipped in the three ways.
std::vector<StudyFile> draw(const ClippedShape& shape);

}  // namespace fathom::studies
