#pragma once

#include <optional>

#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// In pixels, to the right and down.
struct ImageShift {
  double x = 0, y = 0;
};

/// How far the other's samples lie from the centres of the pixels: the shift that explains the
/// differences of depth best, in least squares. Nothing where depths do not tell it, or where it is
/// 4 pixels or more.
std::optional<ImageShift> estimated_shift(const Truth& truth, const OtherMap& other);

}  // namespace fathom::attribution
