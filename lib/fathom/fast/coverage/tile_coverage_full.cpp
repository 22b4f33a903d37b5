#include <algorithm>

#include "fathom/fast/coverage/tile_coverage.h"

// Which pixels of a tile one triangle covers wholly: large triangles, row by row.
namespace fathom::fast {

bool TileCoverage::is_open(const TileBox& box) const {
  if (box.is_empty()) return false;
  const std::uint64_t columns = columns_between(box.left, box.right);
  for (auto row = static_cast<std::size_t>(box.top); row <= static_cast<std::size_t>(box.bottom);
       ++row) {
    if (open_[row] & ~full_[row] & columns) return true;
  }
  return false;
}

bool TileCoverage::misses_tile(const Shape& shape) const {
  const double width = area_.last_column - area_.first_column + 1.0;
  const double height = area_.last_row - area_.first_row + 1.0;
  return std::ranges::any_of(shape.sides(), [&](const UncertainHalfPlane& side) {
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
    add_pixels_inside(shape.sides(), whole(), full_);
    open_shapes_.push_back(shape);
  }
}

/// Looks for pixels that large triangles cover, from `begin` on, as far as open pixels need it;
/// returns whether none is left.
bool TileCoverage::fill_large(std::size_t begin) {
  std::size_t filled = 0;
  for (std::size_t i = begin; i < numbers_.size(); ++i) {
    if (!classes_[i].is_large || !is_open(classes_[i].box)) continue;
    add_pixels_inside(shape_of(object_at(i), i).sides(), classes_[i].box, full_);
    if (++filled % 8 == 0 && !is_open(whole())) return true;
  }
  return !is_open(whole());
}

}  // namespace fathom::fast
