#include <cstddef>

#include "fathom/fast/channels/map_rows.h"

namespace fathom::fast {

BackgroundRows::BackgroundRows(const rendering::MapBackground& background, MapRows rows)
    : rows_(rows) {
  background.for_each([&]<class T>(T* values, T value) {
    Row<T> row;
    row.pixels.fill(value);
    row.values = values;
    channels_.emplace_back(row);
  });
}

void BackgroundRows::write(const PixelBox& part, const MapLayout& layout) const {
  const std::size_t columns = part.last_column - part.first_column + std::size_t{1};
  for (const AnyRow& channel : channels_) {
    std::visit(
        [&](const auto& row) {
          for (std::uint32_t y = part.first_row; y <= part.last_row; ++y) {
            rows_.write(row.pixels, columns, row.values + layout.pixel(part.first_column, y));
          }
        },
        channel);
  }
}

}  // namespace fathom::fast
