#include "validation/scenes/generated/generated_stream.h"

#include <algorithm>
#include <vector>

#include "validation/scenes/generated/generated_scene.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

/// The k-th 21 bits of a number, as a number in [0, 1).
double part_of(std::uint64_t bits, int k) {
  return static_cast<double>(bits >> (21 * k) & 0x1FFFFF) * 0x1p-21;
}

/// A point in the unit cube.
MeshPoint random_point(std::uint64_t number) {
  const std::uint64_t bits = scattered(number);
  return {part_of(bits, 0), part_of(bits, 1), part_of(bits, 2)};
}

/// The k-th of the points that belong to a triangle.
MeshPoint point_of(std::uint32_t triangle, std::uint64_t k) {
  return random_point(4 * std::uint64_t{triangle} + k);
}

/// √(count / 2), rounded up; at least 1.
std::uint32_t columns_for(std::uint32_t count) {
  // From the highest bit on: the greatest number whose square has too few cells.
  std::uint64_t too_few = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 16; bit > 0; bit >>= 1) {
    const std::uint64_t candidate = too_few + bit;
    if (2 * candidate * candidate < count) too_few = candidate;
  }
  return static_cast<std::uint32_t>(too_few + 1);
}

MeshPoint point_at(TerrainHeights& heights, double x, double z) {
  return {as_in_a_file(x), as_in_a_file(heights.at(x)), as_in_a_file(z)};
}

/// The numbers of the points of a line of the grid in a mesh that has a part of them.
struct PointNumbers {
  /// Columns from `split` on have the number from + column, those before it before + column.
  std::uint32_t split = 0, from = 0, before = 0;
  std::uint32_t operator[](std::uint32_t column) const {
    return column + (column < split ? before : from);
  }
};

}  // namespace

std::optional<TriangleStream::Bounds> GeneratedStream::bounds() const {
  if (count_ == 0) return std::nullopt;
  return bounds_;
}

TriangleChunk GeneratedStream::read(std::uint32_t first, std::uint32_t count) const {
  first = std::min(first, count_);
  count = std::min(count, count_ - first);
  TriangleChunk chunk{.first = first, .mesh = {}};
  chunk.mesh.face_count = count;
  chunk.mesh.triangles.reserve(count);
  if (count > 0) add_triangles(first, first + count, chunk.mesh);
  return chunk;
}

SoupStream::SoupStream(std::uint32_t count, double edge)
    : GeneratedStream(count, {{0, 0, 0}, {1, 1, 1}}), edge_(edge) {}

// No coordinate is above 1: with (1 − edge) rounded to the nearest, its sum with the edge is 1
// within half a unit in the last place, and rounding is monotone.
TriangleStream::Triangle SoupStream::triangle(std::uint32_t number) const {
  const MeshPoint place = point_of(number, 3);
  const double room = 1 - edge_;
  Triangle result{.corners = {}, .face = number};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const MeshPoint within = point_of(number, k);
    result.corners[k] = {as_in_a_file(room * place.x + edge_ * within.x),
                         as_in_a_file(room * place.y + edge_ * within.y),
                         as_in_a_file(room * place.z + edge_ * within.z)};
  }
  return result;
}

void SoupStream::add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const {
  std::vector<MeshPoint>& vertices = mesh.vertices.own();
  std::vector<CornerIndices>& triangles = mesh.triangles.own();
  vertices.reserve(3 * std::size_t{end - first});
  for (std::uint32_t number = first; number < end; ++number) {
    const auto vertex = static_cast<std::uint32_t>(vertices.size());
    const Triangle made = triangle(number);
    vertices.insert(vertices.end(), made.corners.begin(), made.corners.end());
    triangles.push_back({vertex, vertex + 1, vertex + 2});
  }
}

TerrainStream::TerrainStream(std::uint32_t count)
    : GeneratedStream(count, {{0, -greatest_height, 0}, {1, greatest_height, 1}}),
      columns_(columns_for(count)),
      side_(1.0 / columns_) {}

TriangleStream::Triangle TerrainStream::triangle(std::uint32_t number) const {
  const std::uint32_t cell = number / 2, row = cell / columns_, column = cell % columns_;
  const double x = column * side_, next_x = (column + 1) * side_;
  const double z = row * side_, next_z = (row + 1) * side_;
  TerrainHeights far(z), near(next_z);
  const MeshPoint left = point_at(far, x, z), right = point_at(near, next_x, next_z);
  if (number % 2 == 0) return {{left, point_at(near, x, next_z), right}, number};
  return {{left, right, point_at(far, next_x, z)}, number};
}

void TerrainStream::add_points(std::uint32_t line, std::uint32_t first, std::uint32_t last,
                               Mesh& mesh) const {
  const double z = line * side_;
  TerrainHeights heights(z);
  std::vector<MeshPoint>& vertices = mesh.vertices.own();
  for (std::uint32_t column = first; column <= last; ++column)
    vertices.push_back(point_at(heights, column * side_, z));
}

void TerrainStream::add_triangles(std::uint32_t first, std::uint32_t end, Mesh& mesh) const {
  const std::uint32_t first_row = first / 2 / columns_, last_row = (end - 1) / 2 / columns_;
  std::vector<CornerIndices>& triangles = mesh.triangles.own();
  mesh.vertices.reserve((end - first) / 2 + 2 * std::size_t{columns_} + 4);
  const auto next = [&] { return static_cast<std::uint32_t>(mesh.vertices.size()); };
  PointNumbers far;
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    const std::uint32_t begin = row == first_row ? first / 2 % columns_ : 0;
    const std::uint32_t last = row == last_row ? (end - 1) / 2 % columns_ : columns_ - 1;
    if (row == first_row) {
      far = {0, next() - begin, 0};
      add_points(row, begin, last + 1, mesh);
    } else if (far.split > 0) {
      // The row before began further on: its points before that are new.
      far.before = next();
      add_points(row, 0, std::min(last + 1, far.split - 1), mesh);
    }
    const PointNumbers near{begin, next() - begin, 0};
    add_points(row + 1, begin, last + 1, mesh);
    for (std::uint32_t column = begin; column <= last; ++column) {
      const std::uint32_t number = 2 * (row * columns_ + column);
      const std::uint32_t left = far[column], right = near[column + 1];
      if (number >= first) triangles.push_back({left, near[column], right});
      if (number + 1 >= first && number + 1 < end)
        triangles.push_back({left, right, far[column + 1]});
    }
    far = near;
  }
}

}  // namespace fathom::bench
