#pragma once

#include "apps/study/study.h"

namespace fathom::studies {

/// The study `blending`.
std::vector<StudyFile> study_blending(const StudyOptions& options,
                                      const std::function<void(double)>& tick);

}  // namespace fathom::studies
