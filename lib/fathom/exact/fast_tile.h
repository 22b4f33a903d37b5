#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/exact/channels.h"
#include "fathom/exact/fast_range.h"
#include "fathom/exact/fast_referee.h"
#include "fathom/exact/fast_setup.h"

namespace fathom {

/// The nearest surface so far at the samples of a small part of the image, whatever the order in
/// which triangles are drawn.
class Tile {
 public:
  static constexpr std::uint32_t size = 64;

  /// What a tile works with, one for each thread.
  struct Context {
    Referee& referee;
    RenderStatistics& statistics;
    const DepthRange& range;
    bool perspective;
  };

  /// Empties the tile and moves it to an area of at most size × size pixels.
  void start(const PixelBox& area);
  [[nodiscard]] const PixelBox& area() const { return area_; }

  /// Draws a triangle at the samples of `box`, within the area and the box of the setup.
  /// `test_range`: whether its depths may leave the range that counts.
  void draw(const TriangleSetup& setup, const PixelBox& box, bool test_range,
            const Context& context);

  /// Writes the visible surfaces; the first fault in row order ends it.
  std::optional<EncodingFault> resolve(ChannelWriter& writer, std::uint32_t image_width,
                                       const Context& context) const;

 private:
  template <bool test_range>
  void draw_box(const TriangleSetup& setup, const PixelBox& box, const Context& context);
  template <bool test_range>
  void draw_block(const TriangleSetup& setup, const PixelBox& box, const Context& context);
  void settle(const TriangleSetup& setup, std::uint32_t column, std::uint32_t row, bool test_range,
              const Context& context);

  [[nodiscard]] std::size_t index(std::uint32_t column, std::uint32_t row) const {
    return static_cast<std::size_t>(row - area_.first_row) * size + (column - area_.first_column);
  }

  PixelBox area_;
  alignas(64) std::array<double, size * size> q_;
  alignas(64) std::array<float, size * size> error_;
  alignas(64) std::array<std::uint32_t, size * size> number_;
};

}  // namespace fathom
