#pragma once

#include "fathom/scene/draw_state.h"
#include "fathom/text/json_value.h"

namespace fathom::scene {

/// Reads "draw" of a scene file: {"depth_test", "depth_write", "colour_write", "polygon_offset":
/// [factor, units], "alpha", "stencil": {"test", "reference", "mask", "write_mask", "fail",
/// "depth_fail", "pass"}}, all of them optional. Comparisons and actions have OpenGL's names in
/// lower case; the depth test can also be "nearer", the default.
/// Fails    InputError, naming the key; unknown keys and words are errors.
DrawState read_draw_state(const text::JsonValue& value);

}  // namespace fathom::scene
