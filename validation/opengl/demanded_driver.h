#pragma once

#include <string>

#include "validation/variants/driver.h"

namespace fathom::validation {

/// Has OpenGL load `driver` on this machine, whatever it would load otherwise. The usual one:
/// nothing is changed.
///
/// Environment  of this process, from then on: what Mesa reads when a display is opened.
/// Needs        a process that has not opened a display through EGL, and has no other threads.
void demand(Driver driver);

/// Fails    InputError, in one line, unless GL_RENDERER is that of the driver.
void require(Driver driver, const std::string& gl_renderer);

}  // namespace fathom::validation
