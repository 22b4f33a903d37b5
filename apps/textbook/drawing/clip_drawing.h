#pragma once

#include "apps/textbook/drawing/picture.h"

namespace fathom::app::drawing {

/// The steps of a case of `fathom clip`, from its answer with --trace: the segment after each split,
/// the ordered parameters, the polygon after each edge or plane, both lists and the walks.
/// Fails    InputError for a case that has no steps, or more than a picture shows.
Picture draw_clip(const std::string& algorithm, const Json& object, const Json& answer);

}  // namespace fathom::app::drawing
