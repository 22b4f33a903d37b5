#pragma once

#include <cstddef>

namespace fathom::memory {

/// Size of a huge page; it begins at a multiple of that.
inline constexpr std::size_t huge_page = std::size_t{1} << 21;

/// Asks the system to provide memory that nothing has been written to yet in huge pages: a page of
/// 4 KiB costs a microsecond or two when it is first written, as much as reading a file into it. A
/// hint: without huge pages, or for memory that contains none, nothing happens.
void prefer_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Reserves room for `count` elements, in huge pages where there are many and the system has these.
template <class List>
void reserve_large(List& list, std::size_t count) {
  if (count <= list.capacity()) return;
  list.reserve(count);
  prefer_huge_pages(list.data() + list.size(),
                    (list.capacity() - list.size()) * sizeof(typename List::value_type));
}

/// The same, and fills it.
template <class List>
void resize_large(List& list, std::size_t count) {
  reserve_large(list, count);
  list.resize(count);
}

}  // namespace fathom::memory
