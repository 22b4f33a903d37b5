#pragma once

#include "apps/study/study.h"

namespace fathom::studies {

/// The study `lines`.
std::vector<StudyFile> study_lines(const StudyOptions& options,
                                   const std::function<void(double)>& tick);

}  // namespace fathom::studies
