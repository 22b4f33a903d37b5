#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// Two nearly coplanar surfaces: the share of samples at which a format lets the wrong one win, by
/// distance and separation, in the ideal and in the pipeline model; the least safe separation,
/// measured and predicted.
/// Defaults: near 0.1, far 100, separation 0.0001, tilt 30°, 64 samples of the patch.
std::vector<StudyFile> study_z_fighting(const StudyOptions& options,
                                        const std::function<void(double)>& tick);

}  // namespace fathom::studies
