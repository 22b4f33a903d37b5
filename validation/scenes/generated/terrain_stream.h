#pragma once

#include "validation/scenes/generated/generated_stream.h"

namespace fathom::bench {

/// A landscape over the unit square of x and z, y up, as a scanner leaves it: a grid of square
/// cells of two triangles each, counter-clockwise from above, row by row from the side of the least
/// z. A row has √(count / 2) cells, rounded up; the last row ends where the triangles do, and there
/// may be a row less than columns.
///
/// Neighbours follow each other: for ranks that draw parts of an image, the kindest order that
/// there is.
class TerrainStream : public GeneratedStream {
 public:
  explicit TerrainStream(std::uint32_t count);
  [[nodiscard]] Triangle triangle(std::uint32_t number) const override;

 private:
  void add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const override;
  /// Adds the points of a line of the grid, first ≤ column ≤ last.
  void add_points(std::uint32_t line, std::uint32_t first, std::uint32_t last, Mesh& mesh) const;

  std::uint32_t columns_;
  double side_;
};

}  // namespace fathom::bench
