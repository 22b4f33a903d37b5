#pragma once

#include "apps/study/study.h"

namespace fathom::studies {

/// The study `hidden-surface`.
std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick);

}  // namespace fathom::studies
