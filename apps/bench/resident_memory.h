#pragma once

#include <cstdint>

/// The memory of this process that is in RAM, in bytes; 0 if the system does not say.
namespace fathom::bench {

std::uint64_t resident_bytes();

/// The greatest resident_bytes() since the process started or forget_peak() was called.
std::uint64_t peak_resident_bytes();

/// Returns freed memory to the system and starts measuring the peak again.
void forget_peak();

}  // namespace fathom::bench
