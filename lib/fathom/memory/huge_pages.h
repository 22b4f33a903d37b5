#pragma once

#include <cstddef>

namespace fathom::memory {

/// Asks the system to provide memory that nothing has been written to yet in huge pages: a page of
/// 4 KiB costs a microsecond or two when it is first written, as much as reading a file into it. A
/// hint: without huge pages, or for little memory, nothing happens.
void prefer_huge_pages(void* memory, std::size_t bytes) noexcept;

}  // namespace fathom::memory
