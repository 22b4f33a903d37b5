#pragma once

#include <cstdint>
#include <vector>

#include "fathom/depth_format/depth_format.h"
#include "validation/opengl/gl_functions.h"

/// What a framebuffer holds, exactly, rows from the top.
namespace fathom::validation {

/// What the driver made of the depth attachment of the framebuffer that is bound to `target`.
/// Fails    InputError where it is of a kind that depth buffers are not known to have.
Storage depth_attachment_storage(const GlFunctions& gl, GLenum target);

/// Window depths of the framebuffer that is bound for reading: read as whole numbers of the
/// storage's own width, of which OpenGL's conversion loses nothing, or as binary32.
std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage);

/// The first colour attachment, of whole numbers.
std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height);

}  // namespace fathom::validation
