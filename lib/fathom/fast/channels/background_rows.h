#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "fathom/fast/channels/map_rows.h"
#include "fathom/geometry/pixel_box.h"
#include "fathom/rendering/map_of_camera.h"

namespace fathom::fast {

/// What channels of a map have where no surface is seen, as rows of a tile that are ready to be
/// written. Several threads may write different pixels at the same time.
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
