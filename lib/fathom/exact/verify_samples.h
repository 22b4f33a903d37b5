#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/exact/projected_triangle.h"
#include "fathom/exact/verify.h"
#include "fathom/scene/approximate_row.h"

namespace fathom {

/// The chosen pixels of consecutive rows of an image, numbered from 0 in row order.
class ChosenRows {
 public:
  /// Takes rows from `first_row` on, at least one, until `enough` pixels are taken or the image
  /// ends.
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

/// Boxes of the triangles of one object: the pixels outside which a triangle covers no sample that
/// counts, as bounding_box() has them or a little larger. Corners are projected in binary64 with a
/// bound, exactly where the bound does not tell whether W > 0; once where triangles that follow
/// each other share them.
class TriangleBoxes {
 public:
  TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera);
  PixelBox box(std::uint32_t triangle);

 private:
  /// Columns and rows from first to last, one corner's image, or beyond the image's sides;
  /// `in_front`: W > 0, without which nothing else is set.
  struct Corner {
    std::uint32_t vertex = 0;
    bool known = false, in_front = false;
    std::int64_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;
  };
  const Corner& corner(std::uint32_t vertex);
  void project(const MeshPoint& p, Corner& corner) const;
  void project_exactly(const MeshPoint& p, Corner& corner) const;
  void set_place(const Interval& U, const Interval& V, const Interval& W, Corner& corner) const;

  const Object& object_;
  const Mesh& mesh_;
  const Camera& camera_;
  /// U, V and W.
  std::array<ApproximateRow, 3> rows_;
  /// The corner that was projected last, of those whose number has the same low bits.
  std::vector<Corner> recent_;
};

}  // namespace fathom
