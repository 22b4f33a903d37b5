#include "fathom/reference/view.h"

#include <algorithm>

#include "fathom/threads/threads.h"

namespace fathom::reference {
using triangle::ProjectedTriangle;

namespace {

bool holds(const PixelBox& outer, const PixelBox& inner) {
  return !outer.is_empty() && outer.contains(inner.first_column, inner.first_row) &&
         outer.contains(inner.last_column, inner.last_row);
}

void add(PixelBox& box, const PixelBox& other) {
  if (box.is_empty()) {
    box = other;
    return;
  }
  box.first_column = std::min(box.first_column, other.first_column);
  box.last_column = std::max(box.last_column, other.last_column);
  box.first_row = std::min(box.first_row, other.first_row);
  box.last_row = std::max(box.last_row, other.last_row);
}

}  // namespace

void RayGroups::Directions::add(const Directions& other) {
  if (other.is_empty) return;
  for (std::size_t k = 0; k < 3; ++k) {
    box[k] = is_empty ? other.box[k]
                      : Interval{std::min(box[k].lower, other.box[k].lower),
                                 std::max(box[k].upper, other.box[k].upper)};
  }
  is_empty = false;
}

bool RayGroups::Directions::may_meet(const ProjectedTriangle& t) const {
  return !is_empty && std::ranges::none_of(t.edges, [&](const LinearForm& edge) {
    return edge.enclose_at(box).upper < 0;
  });
}

RayGroups::Directions RayGroups::around(const lens::Preimages& preimages, const PixelBox& area,
                                        const std::vector<bool>* chosen) const {
  Directions all;
  for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
    for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
      if (chosen && !(*chosen)[std::size_t{row} * width_ + column]) continue;
      if (const auto d = preimages.of_pixel(column, row)) all.add({d->box(), false});
    }
  }
  return all;
}

RayGroups::RayGroups(const lens::Preimages& preimages, std::uint32_t width, std::uint32_t height,
                     const std::vector<bool>* chosen)
    : width_(width), height_(height) {
  Level level{(width - 1) / pixels + 1, (height - 1) / pixels + 1, {}};
  level.groups.resize(std::size_t{level.columns} * level.rows);
  parallel_for(std::size_t{0}, level.groups.size(), [&](std::size_t i) {
    const auto column = static_cast<std::uint32_t>(i % level.columns) * pixels;
    const auto row = static_cast<std::uint32_t>(i / level.columns) * pixels;
    level.groups[i] = around(
        preimages,
        {column, std::min(column + pixels, width) - 1, row, std::min(row + pixels, height) - 1},
        chosen);
  });
  levels_.push_back(std::move(level));
  add_levels();
}

void RayGroups::add_levels() {
  while (levels_.back().groups.size() > 1) {
    const Level& below = levels_.back();
    Level level{(below.columns + 1) / 2, (below.rows + 1) / 2, {}};
    level.groups.resize(std::size_t{level.columns} * level.rows);
    for (std::uint32_t row = 0; row < below.rows; ++row) {
      for (std::uint32_t column = 0; column < below.columns; ++column) {
        level.groups[std::size_t{row / 2} * level.columns + column / 2].add(
            below.groups[std::size_t{row} * below.columns + column]);
      }
    }
    levels_.push_back(std::move(level));
  }
}

PixelBox RayGroups::box_of(const ProjectedTriangle& t) const {
  PixelBox box;
  extend(box, t, levels_.size() - 1, 0, 0);
  return box;
}

/// Adds the pixels of a group that the triangle may meet, by the groups that it is made of.
void RayGroups::extend(PixelBox& box, const ProjectedTriangle& t, std::size_t level,
                       std::uint32_t column, std::uint32_t row) const {
  const Level& groups = levels_[level];
  if (column >= groups.columns || row >= groups.rows) return;
  const std::uint64_t size = std::uint64_t{pixels} << level;
  const PixelBox area{
      static_cast<std::uint32_t>(column * size),
      static_cast<std::uint32_t>(std::min<std::uint64_t>((column + 1) * size, width_) - 1),
      static_cast<std::uint32_t>(row * size),
      static_cast<std::uint32_t>(std::min<std::uint64_t>((row + 1) * size, height_) - 1)};
  if (holds(box, area)) return;
  if (!groups.groups[std::size_t{row} * groups.columns + column].may_meet(t)) return;
  if (level == 0) return add(box, area);
  for (std::uint32_t k = 0; k < 4; ++k)
    extend(box, t, level - 1, 2 * column + k % 2, 2 * row + k / 2);
}

}  // namespace fathom::reference
