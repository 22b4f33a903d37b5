#pragma once

#include "fathom/numeric/certified.h"

namespace fathom {

/// The least integers in the same proportions and with the same signs: of all vectors that differ
/// by a positive factor, the one that stands for them. Zero stays zero.
/// Exact    always.
ExactVector3 without_common_factor(const ExactVector3& v);

}  // namespace fathom
