#include "fathom/memory/huge_pages.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstdint>

namespace fathom::memory {

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = 4096, huge_page = std::uintptr_t{1} << 21;
  // Memory less than two of them in size need not contain one.
  if (bytes < 2 * huge_page) return;
  const auto first = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  const int error = errno;
  ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  errno = error;
#endif
}

}  // namespace fathom::memory
