#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/geometry/frames.h"
#include "fathom/reference/verify.h"
#include "fathom/reference/view.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::reference {

/// The chosen pixels of consecutive rows of an image, numbered from 0 in row order.
class ChosenRows {
 public:
  /// Takes rows from `first_row` on, at least one, until it has `enough` pixels or the image ends.
  ChosenRows(const PixelChoice& chosen, std::uint32_t width, std::uint32_t height,
             std::uint32_t first_row, std::size_t enough);

  [[nodiscard]] std::uint32_t first_row() const { return first_row_; }
  [[nodiscard]] std::uint32_t end_row() const { return end_row_; }
  [[nodiscard]] std::size_t size() const { return columns_.size(); }

  /// Number of the first chosen pixel of a row; end_row() is allowed.
  [[nodiscard]] std::size_t start(std::uint32_t row) const { return starts_[row - first_row_]; }
  [[nodiscard]] std::uint32_t column(std::size_t pixel) const { return columns_[pixel]; }

  struct Range {
    std::size_t first, end;
  };
  /// The chosen pixels of a row within [first_column, last_column].
  [[nodiscard]] Range within(std::uint32_t row, std::uint32_t first_column,
                             std::uint32_t last_column) const;
  /// Whether the box contains a chosen pixel.
  [[nodiscard]] bool meet(const PixelBox& box) const;

 private:
  std::uint32_t first_row_, end_row_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> columns_;
};

/// The chosen pixels of some rows of an image whose rays a lens bends: the nearest triangle so far
/// along the exact ray of each.
class ChosenRays {
 public:
  /// All must outlive it.
  ChosenRays(const View& view, const ChosenRows& chosen, std::uint32_t first_row,
             std::uint32_t end_row);

  /// Tests a triangle at the chosen pixels of its box. Triangles come in the order of their
  /// numbers.
  void draw(triangle::ProjectedTriangle t, const PixelBox& box);

  /// Writes the visible surfaces, and which pixels have a ray, to a map that has a pixel for each
  /// chosen one; calls on_fault(pixel, why) where the encoding does not hold a value.
  void write(triangle::ChannelWriter& writer,
             const std::function<void(std::size_t, const std::string&)>& on_fault) const;

 private:
  struct Pixel {
    std::optional<lens::ExactDirection> ray;
    const triangle::ProjectedTriangle* nearest = nullptr;
  };

  const View& view_;
  const ChosenRows& chosen_;
  std::uint32_t first_row_, end_row_;
  std::vector<Pixel> pixels_;
  /// Triangles that are or were the nearest of a pixel.
  std::deque<triangle::ProjectedTriangle> triangles_;
};

}  // namespace fathom::reference
