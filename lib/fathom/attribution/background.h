#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A map whose background was told from surfaces by what stands where the truth has none.
struct KnownBackground {
  OtherMap map;
  /// Of kind `background`. Nothing where the background is infinite, as ours is.
  std::optional<Finding> note;
};

/// The background is the most frequent value of the pixels around which the exact map is empty: the
/// far plane's depth, 0, −1, 1, NaN, …. Returns the map unchanged if there are too few such pixels,
/// if they do not agree, or if the map's values are unknown.
KnownBackground known_background(const Truth& truth, const OtherMap& other);

}  // namespace fathom::attribution
