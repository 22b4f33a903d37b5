#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// z-fighting on options.scene: which pixels fight in every format, with pictures; the greatest
/// separations that are lost, by distance.
std::vector<StudyFile> study_scene_fights(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

}  // namespace fathom::studies
