#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// Coverage by samples against the exact area `A`: the error of every pattern, and how many of the
/// pixels that an edge crosses 1, 2, 4 and 8 samples see as partly covered. Default: a wheel.
std::vector<StudyFile> study_antialiasing(const StudyOptions& options,
                                          const std::function<void(double)>& tick);

}  // namespace fathom::studies
