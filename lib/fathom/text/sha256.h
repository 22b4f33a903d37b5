#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "fathom/text/random_access_file.h"

namespace fathom::text {

/// SHA-256 (FIPS 180-4) of `bytes`, as 64 hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

/// Of a whole file, read piece by piece.
/// Fails    InputError if it cannot be read.
std::string sha256(const RandomAccessFile& file);

}  // namespace fathom::text
