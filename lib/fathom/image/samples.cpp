#include "fathom/image/samples.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "fathom/memory/huge_pages.h"

namespace fathom {
namespace {

#ifdef __linux__

using memory::huge_page;

bool is_large(std::size_t bytes) {
  return bytes >= huge_page;
}

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + huge_page - 1) / huge_page * huge_page;
}

/// A mapping that begins at a multiple of the huge-page size: only these get huge pages.
void* map_zeros(std::size_t bytes) {
  const std::size_t length = whole_pages(bytes), room = length + huge_page;
  void* mapped = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  const auto address = reinterpret_cast<std::uintptr_t>(mapped);
  const std::size_t before = whole_pages(address) - address, after = huge_page - before;
  auto* zeros = static_cast<std::byte*>(mapped) + before;
  if (before > 0) munmap(mapped, before);
  if (after > 0) munmap(zeros + length, after);
  memory::prefer_huge_pages(zeros, length);
  return zeros;
}

#endif

}  // namespace

void* allocate_zeros(std::size_t bytes) {
  if (bytes == 0) return nullptr;
#ifdef __linux__
  if (bytes > SIZE_MAX / 2) throw std::bad_alloc();
  if (is_large(bytes)) return map_zeros(bytes);
#endif
  void* memory = std::calloc(bytes, 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void free_zeros(void* memory, std::size_t bytes) noexcept {
  if (!memory) return;
#ifdef __linux__
  if (is_large(bytes)) {
    munmap(memory, whole_pages(bytes));
    return;
  }
#endif
  std::free(memory);
}

}  // namespace fathom
