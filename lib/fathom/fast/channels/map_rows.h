#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/geometry/frames.h"
#include "fathom/rendering/map_background.h"

namespace fathom::fast {

/// Where a map has the pixels of an image: from a row of the image on, row by row.
struct MapLayout {
  std::uint32_t width;
  std::uint32_t first_row = 0;

  [[nodiscard]] std::size_t pixel(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row - first_row} * width + column;
  }
};

/// Values of a row of a tile, put together before they are written to a map.
template <class T>
struct alignas(64) MapRow : std::array<T, TileShape::size> {};

/// How rows are written to a map: as usual if the system has just provided its memory, otherwise
/// past the caches. Then no write waits for the previous content of the memory: writing a tile's
/// rows into a map of 8 MB, with other writes in between, takes a third of the time of ordinary
/// writes. Other threads see the written values after finish() of this thread.
struct MapRows {
  bool past_caches = false;

  template <class T>
  void write(const MapRow<T>& row, std::size_t columns, T* to) const {
    if (past_caches) {
      write_past_caches(row.data(), columns * sizeof(T), to);
    } else {
      std::copy_n(row.begin(), columns, to);
    }
  }
  void finish() const;

 private:
  static void write_past_caches(const void* from, std::size_t bytes, void* to);
};

/// The background of a map's channels, as rows of a tile that are ready to be written. Several
/// threads may write different pixels at the same time.
class BackgroundRows {
 public:
  BackgroundRows(const rendering::MapBackground& background, MapRows rows);
  /// All pixels of a part of the image that is at most as large as a tile; others see them after
  /// MapRows::finish().
  void write(const PixelBox& part, const MapLayout& layout) const;

 private:
  template <class T>
  struct Row {
    MapRow<T> pixels;
    /// The channel's.
    T* values;
  };
  using AnyRow = std::variant<Row<float>, Row<double>, Row<std::uint16_t>, Row<std::uint32_t>>;

  MapRows rows_;
  std::vector<AnyRow> channels_;
};

}  // namespace fathom::fast
