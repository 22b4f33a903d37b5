#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// What moving corners to a subpixel grid does to coverage and depth: 0 to 16 bits against the
/// exact map. Default: a wheel.
std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

}  // namespace fathom::studies
