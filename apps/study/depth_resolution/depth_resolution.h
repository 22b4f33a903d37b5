#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// The step of every depth format (mapping by storage) in world units, against depth; where each is
/// best; how it moves with near and with far. All figures are exact, rounded once.
/// Defaults: near 0.1, far 1000, 121 depths evenly spaced in the logarithm.
std::vector<StudyFile> study_depth_resolution(const StudyOptions& options,
                                              const std::function<void(double)>& tick);

}  // namespace fathom::studies
