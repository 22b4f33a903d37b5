#pragma once

#include "apps/study/study.h"

namespace fathom::studies {

/// The study `course`.
std::vector<StudyFile> study_course(const StudyOptions& options,
                                    const std::function<void(double)>& tick);

}  // namespace fathom::studies
