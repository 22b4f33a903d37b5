#pragma once

#include <cstdint>
#include <string>

namespace fathom::test {

/// Maps of zeros, packed as tightly as their formats allow, without ever being held unpacked: an
/// EXR of one channel Z in ZIP compression, a PNG of 16 bits.
std::string black_exr(std::uint32_t width, std::uint32_t height);
std::string black_png(std::uint32_t width, std::uint32_t height);

}  // namespace fathom::test
