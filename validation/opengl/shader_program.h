#pragma once

#include "validation/opengl/gl_functions.h"

namespace fathom::validation {

/// A program of two shaders, from their texts; it is in use from then on.
/// Fails    InputError where the driver does not take them.
GLuint use_new_program(const GlFunctions& gl, const char* vertex_shader,
                       const char* fragment_shader);

}  // namespace fathom::validation
