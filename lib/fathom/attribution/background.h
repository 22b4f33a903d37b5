#pragma once

#include <optional>

#include "fathom/attribution/finding.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A map whose background was told from surfaces by what stands where the truth has none.
struct KnownBackground {
  OtherMap map;
  /// Of kind `background`. Nothing where the background is infinite, as ours is.
  std::optional<Finding> note;
};

/// The value that most of the pixels hold around which the exact map shows nothing is the
/// background, and it alone: the far plane's depth, 0, −1, 1, NaN, …. The map as it is where there
/// are too few such pixels, they do not agree, or its values are not known.
KnownBackground known_background(const Truth& truth, const OtherMap& other);

}  // namespace fathom::attribution
