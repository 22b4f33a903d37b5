#include "fathom/memory/huge_pages.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstdint>

namespace fathom::memory {

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = 4096, huge_page = std::size_t{1} << 21;
  // Memory less than two of them in size need not contain one.
  if (bytes < 2 * huge_page) return;
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
  const int error = errno;
  ::madvise(static_cast<std::byte*>(memory) + before, bytes - before, MADV_HUGEPAGE);
  errno = error;
#endif
}

}  // namespace fathom::memory
