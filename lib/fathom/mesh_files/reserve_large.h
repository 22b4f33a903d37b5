#pragma once

#include <cstddef>

#include "fathom/memory/huge_pages.h"

/// For this room's .cpp files only.
namespace fathom::mesh_files {

/// Reserves room for `count` elements, in huge pages where there are many and the system has these.
template <class List>
void reserve_large(List& list, std::size_t count) {
  if (count <= list.capacity()) return;
  list.reserve(count);
  memory::prefer_huge_pages(list.data() + list.size(),
                            (list.capacity() - list.size()) * sizeof(typename List::value_type));
}

/// The same, and fills it.
template <class List>
void resize_large(List& list, std::size_t count) {
  reserve_large(list, count);
  list.resize(count);
}

}  // namespace fathom::mesh_files
