#include "fathom/exact/verify_samples.h"

#include <algorithm>
#include <cmath>

namespace fathom {

ChosenRows::ChosenRows(const PixelChoice& chosen, std::uint32_t width, std::uint32_t height,
                       std::uint32_t first_row, std::size_t enough)
    : first_row_(first_row), end_row_(first_row), starts_{0} {
  while (end_row_ < height && (end_row_ == first_row_ || columns_.size() < enough)) {
    const std::size_t row = static_cast<std::size_t>(end_row_) * width;
    for (std::uint32_t column = 0; column < width; ++column) {
      if (chosen[row + column]) columns_.push_back(column);
    }
    starts_.push_back(columns_.size());
    ++end_row_;
  }
}

ChosenRows::Range ChosenRows::within(std::uint32_t row, std::uint32_t first_column,
                                     std::uint32_t last_column) const {
  const auto begin = columns_.begin() + static_cast<std::ptrdiff_t>(start(row));
  const auto end = columns_.begin() + static_cast<std::ptrdiff_t>(start(row + 1));
  const auto first = std::lower_bound(begin, end, first_column);
  const auto last = std::upper_bound(first, end, last_column);
  return {static_cast<std::size_t>(first - columns_.begin()),
          static_cast<std::size_t>(last - columns_.begin())};
}

bool ChosenRows::meet(const PixelBox& box) const {
  if (box.is_empty()) return false;
  const std::uint32_t end = std::min(box.last_row + 1, end_row_);
  for (std::uint32_t row = std::max(box.first_row, first_row_); row < end; ++row) {
    const Range found = within(row, box.first_column, box.last_column);
    if (found.first != found.end) return true;
  }
  return false;
}

namespace {

constexpr std::size_t remembered_corners = 4096;

/// The integers near an interval of the image, one more on each side, so that roundings of the ends
/// do no harm; `first` at most `count`, `last` at least −1. An end that is not known (NaN) is that
/// of the image.
void near(const Interval& range, std::uint32_t count, std::int64_t& first, std::int64_t& last) {
  const double low = std::floor(range.lower) - 1, high = std::ceil(range.upper) + 1;
  const double size = count;
  first = std::isnan(low) ? 0 : static_cast<std::int64_t>(std::clamp(low, 0.0, size));
  last = std::isnan(high) ? std::int64_t{count} - 1
                          : static_cast<std::int64_t>(std::clamp(high, -1.0, size - 1));
}

}  // namespace

TriangleBoxes::TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera)
    : object_(object), mesh_(mesh), camera_(camera), recent_(remembered_corners) {}

const TriangleBoxes::Corner& TriangleBoxes::corner(std::uint32_t vertex) {
  Corner& slot = recent_[vertex % remembered_corners];
  if (slot.known && slot.vertex == vertex) return slot;
  const MeshPoint& p = mesh_.vertices[vertex];
  const WorldPoint world =
      object_.placed_as_is ? WorldPoint{p.x, p.y, p.z} : object_.world_from_mesh(p);
  const HomogeneousImagePoint image = to_image(camera_, to_camera(camera_, world));
  slot = {.vertex = vertex, .known = true, .in_front = image.W.sign() == Sign::positive};
  if (!slot.in_front) return slot;
  const Interval W = enclose(image.W);
  near(quotient(enclose(image.U), W), camera_.width, slot.first_column, slot.last_column);
  near(quotient(enclose(image.V), W), camera_.height, slot.first_row, slot.last_row);
  return slot;
}

PixelBox TriangleBoxes::box(std::uint32_t triangle) {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  const Corner A = corner(a), B = corner(b), C = corner(c);
  if (!A.in_front && !B.in_front && !C.in_front) return {};  // D ≤ 0 everywhere
  if (!A.in_front || !B.in_front || !C.in_front) {
    return {0, camera_.width - 1, 0, camera_.height - 1};
  }
  const std::int64_t first_column = std::min({A.first_column, B.first_column, C.first_column});
  const std::int64_t last_column = std::max({A.last_column, B.last_column, C.last_column});
  const std::int64_t first_row = std::min({A.first_row, B.first_row, C.first_row});
  const std::int64_t last_row = std::max({A.last_row, B.last_row, C.last_row});
  if (first_column > last_column || first_row > last_row) return {};
  return {static_cast<std::uint32_t>(first_column), static_cast<std::uint32_t>(last_column),
          static_cast<std::uint32_t>(first_row), static_cast<std::uint32_t>(last_row)};
}

}  // namespace fathom
