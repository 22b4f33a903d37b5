#pragma once

#include <cstdint>

#include "fathom/depth_format/depth_format.h"

/// Depth buffers as OpenGL describes and reads them.
namespace fathom {

/// The storage of an attachment for which OpenGL reports so many bits per depth, as integers or
/// floating-point numbers.
///
/// Fails    InputError unless it has 16, 24 or 32 bits or is binary32.
Storage storage_of_attachment(int bits, bool is_floating_point);

/// The window depth, 0 to 1, of an integer as glReadPixels returns it for a unorm storage: 16 bits
/// as GL_UNSIGNED_SHORT, otherwise GL_UNSIGNED_INT, in which OpenGL puts 24 bits into the upper
/// bits.
///
/// Exact    rounded once.
double window_depth_of_pixel(Storage storage, std::uint32_t pixel);

}  // namespace fathom
