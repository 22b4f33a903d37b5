#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "fathom/files/random_access_file.h"

namespace fathom::files {

/// SHA-256 ([SHS15]) of `bytes`, as 64 hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

/// SHA-256 of a whole file, read piece by piece.
/// Fails    InputError if it cannot be read.
std::string sha256(const RandomAccessFile& file);

}  // namespace fathom::files
