#pragma once

#include <cstdint>
#include <optional>

#include "fathom/mesh_files/triangle_stream.h"

namespace fathom::bench {

/// Triangles that are made when they are asked for, each a function of its number: as many as a
/// benchmark wants, without a file and without memory. Coordinates are binary32 numbers, as most
/// files have them. Faces are triangles.
class GeneratedStream : public TriangleStream {
 public:
  /// `bounds` hold all corners; they need not be the closest.
  GeneratedStream(std::uint32_t count, const Bounds& bounds) : count_(count), bounds_(bounds) {}

  [[nodiscard]] std::uint32_t triangle_count() const override { return count_; }
  [[nodiscard]] std::uint64_t face_count() const override { return count_; }
  [[nodiscard]] std::optional<Bounds> bounds() const override;
  [[nodiscard]] TriangleChunk read(std::uint32_t first, std::uint32_t count) const override;
  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const override { return number; }

 private:
  /// Adds triangles first ≤ number < end, at least one, all of which there are. They have the
  /// corners that triangle() gives them, bit for bit.
  virtual void add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const = 0;

  std::uint32_t count_;
  Bounds bounds_;
};

/// The nearest binary32 number.
inline double as_in_a_file(double value) {
  return static_cast<double>(static_cast<float>(value));
}

/// Triangles anywhere in the unit cube, in no order at all: for ranks that draw parts of an image,
/// the worst that there is. Nothing is shared.
class SoupStream : public GeneratedStream {
 public:
  /// Each triangle lies in a cube of this edge, its corners anywhere in that.
  /// Needs    0 < edge ≤ 1.
  SoupStream(std::uint32_t count, double edge);
  [[nodiscard]] Triangle triangle(std::uint32_t number) const override;

 private:
  void add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const override;

  double edge_;
};

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
