#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace fathom::fast {

/// Calls visit(k) for each bit k that is 1, from the lowest on.
template <class Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace fathom::fast
