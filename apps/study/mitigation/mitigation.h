#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// What helps against z-fighting: a farther near plane, polygon offset, reversed z, a logarithmic
/// mapping; pixels that fight before and after, and hidden surfaces that an offset makes show.
/// Defaults: panels with decals at twelve distances, near 0.01, far 1000, standard unorm24.
std::vector<StudyFile> study_mitigation(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

}  // namespace fathom::studies
