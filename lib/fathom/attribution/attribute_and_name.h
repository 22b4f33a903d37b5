#pragma once

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// attribute(), and where pixels stay unexplained or depths are off on the whole, a search for what
/// would explain them all (docs/validation.md, "Findings"). Each hypothesis is a model or a map
/// with one thing put right, and holds where at most a tenth of the unexplained pixels is left.
/// Findings are named; the pixels that the one of the whole image explains become `convention`.
Attribution attribute_and_name(const Truth& truth, const OtherMap& other,
                               const RendererModel& model);

}  // namespace fathom::attribution
