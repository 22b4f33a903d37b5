#pragma once

#include <cstdint>
#include <vector>

#include "fathom/depth_format/depth_format.h"
#include "validation/opengl/gl_functions.h"

/// What a framebuffer holds, exactly. Rows run from the top.
namespace fathom::validation {

/// The type that the driver gave the depth attachment of the framebuffer bound to `target`.
/// Fails    InputError if depth buffers are not known to have that type.
Storage depth_attachment_storage(const GlFunctions& gl, GLenum target);

/// Window depths of the framebuffer bound for reading: read as integers of the storage's own width,
/// which OpenGL's conversion leaves exact, or as binary32.
std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage);

/// The first colour attachment, whose texels are integers.
std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height);

}  // namespace fathom::validation
