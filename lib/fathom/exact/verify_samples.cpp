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

/// U, V and W as exact affine functions of the mesh point, by their values at four points.
std::array<ApproximateRow, 3> image_rows(const Object& object, const Camera& camera) {
  const auto image = [&](const MeshPoint& p) {
    const HomogeneousImagePoint a = to_image(camera, to_camera(camera, object.world_from_mesh(p)));
    return ExactVector3{a.U, a.V, a.W};
  };
  const ExactVector3 origin = image({0, 0, 0}), x = image({1, 0, 0}), y = image({0, 1, 0}),
                     z = image({0, 0, 1});
  const auto row = [&](std::size_t i) {
    return ApproximateRow({x[i] - origin[i], y[i] - origin[i], z[i] - origin[i], origin[i]});
  };
  return {row(0), row(1), row(2)};
}

}  // namespace

TriangleBoxes::TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera)
    : object_(object),
      mesh_(mesh),
      camera_(camera),
      rows_(image_rows(object, camera)),
      recent_(remembered_corners) {}

const TriangleBoxes::Corner& TriangleBoxes::corner(std::uint32_t vertex) {
  Corner& slot = recent_[vertex % remembered_corners];
  if (slot.known && slot.vertex == vertex) return slot;
  slot = {.vertex = vertex, .known = true};
  project(mesh_.vertices[vertex], slot);
  return slot;
}

void TriangleBoxes::project(const MeshPoint& p, Corner& corner) const {
  const Interval W = rows_[2].at(p);
  if (W.lower > 0) {
    set_place(rows_[0].at(p), rows_[1].at(p), W, corner);
  } else if (!(W.upper <= 0)) {
    project_exactly(p, corner);
  }
}

void TriangleBoxes::project_exactly(const MeshPoint& p, Corner& corner) const {
  const HomogeneousImagePoint image =
      to_image(camera_, to_camera(camera_, object_.world_from_mesh(p)));
  if (image.W.sign() != Sign::positive) return;
  set_place(enclose(image.U), enclose(image.V), enclose(image.W), corner);
}

void TriangleBoxes::set_place(const Interval& U, const Interval& V, const Interval& W,
                              Corner& corner) const {
  corner.in_front = true;
  near(quotient(U, W), camera_.width, corner.first_column, corner.last_column);
  near(quotient(V, W), camera_.height, corner.first_row, corner.last_row);
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
