#pragma once

#include <cstdint>

/// Memory of this process that is in RAM, in bytes; 0 where the system does not tell.
namespace fathom::bench {

std::uint64_t resident_bytes();

/// The greatest resident_bytes() since the process started or forget_peak() was called.
std::uint64_t peak_resident_bytes();

/// Gives what was freed back to the system and starts the peak anew.
void forget_peak();

}  // namespace fathom::bench
