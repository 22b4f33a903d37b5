#include <bit>

#include "fathom/fast/coverage/tile_coverage.h"
#include "fathom/fast/coverage/tile_functions.h"
#include "fathom/fast/lanes/each_bit.h"

// The number of triangles that cover a point of an open pixel: from the outlines, along its row, if
// no triangle covers some pixel of the row; otherwise from the triangles.
namespace fathom::fast {

void TileCoverage::prepare_counts() {
  find_references();
  meet_triangles();
}

// No triangle covers a pixel that is not open and whose sample shows no surface. If open triangles
// meet the tile, the triangles of pixels are needed in any case. Many edges take more time for
// every pixel than its triangles.
void TileCoverage::find_references() {
  constexpr std::size_t most_edges_in_row = 32;
  reference_.fill(-1);
  if (!open_shapes_.empty()) return;
  const TileBox whole = whole_tile(area_);
  for (std::uint32_t row = 0; row <= static_cast<std::uint32_t>(whole.bottom); ++row) {
    const std::uint64_t empty =
        ~shown_[row] & ~open_[row] & columns_between(whole.left, whole.right);
    if (empty == 0 || outlines_.edges_in_row(row) > most_edges_in_row) continue;
    reference_[row] = std::countr_zero(empty);
  }
}

void TileCoverage::meet_triangles() {
  auto next_open = open_shapes_.begin();
  met_.fill(0);
  shapes_.clear();
  shapes_at_.clear();
  TileRows asked = open_;
  for (std::size_t row = 0; row < size; ++row) {
    if (reference_[row] >= 0) asked[row] = 0;
  }
  std::swap(asked, open_);
  const bool any = is_open(whole_tile(area_));
  for (std::size_t i = 0; any && i < numbers_.size(); ++i) {
    const auto& [kind, is_large, box] = classes_[i];
    if (kind == CoverageClass::open) {
      meet(whole_tile(area_), *next_open++);
      continue;
    }
    if (kind == CoverageClass::nothing || !is_open(box)) continue;
    meet(box, shape_of(object_at(i), i));
  }
  for (std::size_t row = 0; row < size; ++row) {
    if (reference_[row] >= 0) open_[row] = asked[row];
  }
  shapes_at_.sort();
}

TileCoverage::Sides TileCoverage::is_pixel_of(const Shape& shape, int column, int row) {
  Sides sides;
  for (const UncertainHalfPlane& side : shape.sides()) {
    const auto [least, greatest] = values_in_pixel(side, column, row);
    sides.inside = sides.inside && least > side.error;
    sides.outside = sides.outside || greatest < -side.error;
  }
  if (shape.is_open && !sides.outside) {
    sides.outside = certainly_misses_pixel(shape.sides(), column, row);
  }
  return sides;
}

void TileCoverage::meet(const TileBox& box, const Shape& shape) {
  constexpr int wide = 6;
  shapes_.push_back(shape);
  TileRows may_be_met;
  const bool is_wide = box.right - box.left >= wide;
  if (is_wide) find_pixels_met(shape.sides(), box, may_be_met);
  for (int top = box.top; top <= box.bottom; ++top) {
    const auto row = static_cast<std::size_t>(top);
    const std::uint64_t columns =
        open_[row] & (is_wide ? may_be_met[row] : columns_between(box.left, box.right));
    for (const std::size_t column : EachBit(columns)) {
      const auto [inside, outside] = is_pixel_of(shape, static_cast<int>(column), top);
      if (inside) {
        open_[row] &= ~(std::uint64_t{1} << column);
        met_[row] |= std::uint64_t{1} << column;
      } else if (!outside) {
        shapes_at_.add(static_cast<std::uint32_t>(row * size + column), shapes_.size() - 1);
      }
    }
  }
}

int TileCoverage::number_at(std::uint32_t pixel, const SquarePoint& point) const {
  const std::uint32_t row = pixel / size;
  if (reference_[row] < 0) return number_of_shapes_at(pixel, point);
  return outlines_.difference(row, point, static_cast<std::uint32_t>(reference_[row])).value_or(-1);
}

int TileCoverage::number_of_shapes_at(std::uint32_t pixel, const SquarePoint& point) const {
  int number = 0;
  for (const std::uint32_t i : shapes_at_.at(pixel)) {
    bool inside = true, outside = false;
    for (const auto& [a, b, c, error] : shapes_[i].sides()) {
      const double f = c + a * point.x + b * point.y;
      inside = inside && f > error;
      outside = outside || f < -error;
    }
    if (!inside && !outside) return -1;
    if (inside) ++number;
  }
  return number;
}

std::span<const std::uint32_t> TileCoverage::triangles_at(std::uint32_t pixel) {
  triangles_at_.clear();
  if (reference_[pixel / size] < 0) {
    for (const std::uint32_t i : shapes_at_.at(pixel)) {
      triangles_at_.push_back(number_in_scene(shapes_[i].triangle));
    }
    return triangles_at_;
  }
  const auto row = static_cast<int>(pixel / size), column = static_cast<int>(pixel % size);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const auto& [kind, is_large, box] = classes_[i];
    if (kind == CoverageClass::nothing || column < box.left || box.right < column ||
        row < box.top || box.bottom < row) {
      continue;
    }
    if (!is_pixel_of(shape_of(object_at(i), i), column, row).outside) {
      triangles_at_.push_back(number_in_scene(i));
    }
  }
  return triangles_at_;
}

}  // namespace fathom::fast
