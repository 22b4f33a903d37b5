#pragma once

#include <cstddef>
#include <span>

namespace fathom {

/// Whether a file begins as maps do: those that read_map() reads, and TIFF, which it refuses by
/// name.
bool is_map(std::span<const std::byte> bytes);

}  // namespace fathom
