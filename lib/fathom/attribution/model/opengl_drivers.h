#pragma once

#include <string>

namespace fathom::attribution {

/// Whether an OpenGL driver, recognised by what it says of itself (GL_RENDERER), interpolates depth
/// between the corners as they were before they were snapped. OpenGL leaves this open. Mesa's
/// llvmpipe does; of other drivers it is not assumed, which gives the wider bound.
bool interpolates_before_snapping(const std::string& description);

}  // namespace fathom::attribution
