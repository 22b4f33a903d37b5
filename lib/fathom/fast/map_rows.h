#pragma once

#include <array>
#include <cstddef>

namespace fathom::fast {

/// Samples of a row of a tile.
inline constexpr std::size_t samples_of_row = 64;

/// Values of a row of a tile, put together before they are written to a map.
template <class T>
struct alignas(64) MapRow : std::array<T, samples_of_row> {};

/// Writes bytes to a map past the caches, `from` a multiple of 64. Nothing waits for what the memory
/// held before: writing a tile's rows into a map of 8 MB, other writes in between, takes a third of
/// the time of ordinary writes. Other threads see them after finish_map_rows() of this thread.
void write_map_row(const void* from, std::size_t bytes, void* to);
void finish_map_rows();

template <class T>
void write_map_row(const MapRow<T>& row, std::size_t columns, T* to) {
  write_map_row(row.data(), columns * sizeof(T), to);
}

}  // namespace fathom::fast
