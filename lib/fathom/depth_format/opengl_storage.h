#pragma once

#include <cstdint>

#include "fathom/depth_format/depth_format.h"

/// Depth buffers as OpenGL describes and reads them.
namespace fathom {

/// What an attachment stores of which OpenGL says that it has so many bits per depth, of
/// floating-point numbers or not.
///
/// Fails    InputError if it is none of 16, 24, 32 bits and binary32.
Storage storage_of_attachment(int bits, bool is_floating_point);

/// The window depth, 0 to 1, of an integer as glReadPixels returns it for a unorm storage: of 16
/// bits as GL_UNSIGNED_SHORT, of others as GL_UNSIGNED_INT, in which OpenGL puts 24 bits into the
/// upper ones.
///
/// Exact    rounded once.
double window_depth_of_pixel(Storage storage, std::uint32_t pixel);

}  // namespace fathom
