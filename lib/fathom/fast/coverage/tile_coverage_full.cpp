#include <algorithm>
#include <cmath>

#include "fathom/fast/coverage/tile_coverage.h"

// Which pixels of a tile one triangle covers wholly: large triangles, row by row.
namespace fathom::fast {

bool TileCoverage::is_full(const TileBox& box) const {
  if (box.is_empty()) return true;
  const std::uint64_t columns = columns_between(box.left, box.right);
  for (int row = box.top; row <= box.bottom; ++row) {
    if (~full_[static_cast<std::size_t>(row)] & columns) return false;
  }
  return true;
}

// A division finds where, in a row of pixels, a function is greater than its error at all four
// corners of a pixel; the two ends that come out are then tested. Products and sums are rounded
// monotonically, so what holds at two pixels holds between them.
void TileCoverage::fill(const Shape& shape, const TileBox& box) {
  for (int row = box.top; row <= box.bottom; ++row) {
    double first = box.left, last = box.right;
    std::array<double, 5> least{};
    for (std::size_t k = 0; k < shape.count; ++k) {
      const auto& [a, b, c, error] = shape.sides[k];
      least[k] = c + b * (row + 0.5) - (std::abs(a) + std::abs(b)) / 2;
      const double root = (error - least[k]) / a - 0.5;
      if (a > 0) first = std::max(first, std::floor(root) + 1);
      if (a < 0) last = std::min(last, std::ceil(root) - 1);
    }
    const auto is_inside = [&](double column) {
      for (std::size_t k = 0; k < shape.count; ++k) {
        const auto& side = shape.sides[k];
        if (!(least[k] + side.a * (column + 0.5) > side.error)) return false;
      }
      return true;
    };
    if (!(first <= last) || !is_inside(first) || !is_inside(last)) continue;
    full_[static_cast<std::size_t>(row)] |=
        columns_between(static_cast<int>(first), static_cast<int>(last));
  }
}

bool TileCoverage::misses_tile(const Shape& shape) const {
  const double width = area_.last_column - area_.first_column + 1.0;
  const double height = area_.last_row - area_.first_row + 1.0;
  return std::any_of(shape.sides.begin(), shape.sides.begin() + shape.count, [&](const auto& side) {
    return side.c + std::max(side.a, 0.0) * width + std::max(side.b, 0.0) * height < -side.error;
  });
}

void TileCoverage::look_at_open(std::size_t begin, const Tile::Context& context) {
  for (std::size_t i = begin; i < numbers_.size(); ++i) {
    if (classes_[i].kind != CoverageClass::open) continue;
    const Shape shape = exact_shape(i, context);
    if (misses_tile(shape)) {
      classes_[i].kind = CoverageClass::nothing;
      continue;
    }
    fill(shape, whole());
    open_shapes_.push_back(shape);
  }
}

void TileCoverage::fill_large(std::size_t begin) {
  std::size_t filled = 0;
  for (std::size_t i = begin; i < numbers_.size(); ++i) {
    if (!classes_[i].is_large || is_full(classes_[i].box)) continue;
    fill(shape_of(object_at(i), i), classes_[i].box);
    if (++filled % 8 == 0 && is_full(whole())) return;
  }
}

}  // namespace fathom::fast
