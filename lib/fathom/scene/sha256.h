#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace fathom {

/// SHA-256 (FIPS 180-4) of `bytes`, as 64 hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

}  // namespace fathom
