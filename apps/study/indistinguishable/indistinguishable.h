#pragma once

#include <functional>
#include <vector>

#include "apps/study/study.h"

namespace fathom::studies {

/// Of many depths between near and far, how many neighbours are stored as equal, and how many
/// swapped, for every projection, storage and way to apply the matrices, in exact arithmetic, with
/// each source of rounding alone and with all of them.
/// Defaults: near 0.1, far 10000, 10001 depths.
/// Source   N. Reed, Depth Precision Visualized (2015); P. Upchurch, M. Desbrun, Tightening the
///          Precision of Perspective Rendering, JGT 16 (2012).
std::vector<StudyFile> study_indistinguishable(const StudyOptions& options,
                                               const std::function<void(double)>& tick);

}  // namespace fathom::studies
