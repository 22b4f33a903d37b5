#include "fathom/memory/huge_pages.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstdint>

namespace fathom::memory {

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = 4096;
  // The distance from the beginning to the next multiple.
  const auto before = [&](std::size_t size) {
    return (size - reinterpret_cast<std::uintptr_t>(memory) % size) % size;
  };
  if (bytes < before(huge_page) + huge_page) return;  // contains none
  const int error = errno;
  ::madvise(static_cast<std::byte*>(memory) + before(page), bytes - before(page), MADV_HUGEPAGE);
  errno = error;
#endif
}

}  // namespace fathom::memory
