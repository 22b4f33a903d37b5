#include "fathom/triangle/triangle_boxes.h"

#include <algorithm>
#include <cmath>

#include "fathom/triangle/image_rows.h"

namespace fathom::triangle {
namespace {

constexpr std::size_t remembered_corners = 4096;

/// The integers near an interval of the image, one more on each side, so that roundings of the ends
/// do no harm; `first` at most `count`, `last` at least −1. An end that is not known (NaN) becomes
/// that of the image.
void near(const Interval& range, std::uint32_t count, std::int64_t& first, std::int64_t& last) {
  const double low = std::floor(range.lower) - 1, high = std::ceil(range.upper) + 1;
  const double size = count;
  first = std::isnan(low) ? 0 : static_cast<std::int64_t>(std::clamp(low, 0.0, size));
  last = std::isnan(high) ? std::int64_t{count} - 1
                          : static_cast<std::int64_t>(std::clamp(high, -1.0, size - 1));
}

std::array<ApproximateRow, 3> approximate_rows(const Object& object, const Camera& camera) {
  const auto rows = image_rows(object, camera);
  return {ApproximateRow(rows[0]), ApproximateRow(rows[1]), ApproximateRow(rows[2])};
}

}  // namespace

TriangleBoxes::TriangleBoxes(const Object& object, const Mesh& mesh, const Camera& camera)
    : object_(object),
      mesh_(mesh),
      camera_(camera),
      rows_(approximate_rows(object, camera)),
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
      to_image(camera_.projection, to_camera(camera_.world_to_camera, object_.world_from_mesh(p)));
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

}  // namespace fathom::triangle
