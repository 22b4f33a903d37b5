#include "fathom/triangle/triangle_boxes.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/certified.h"

namespace fathom::triangle {

// An affine function follows from its values at four points.
std::array<std::array<Dyadic, 4>, 3> image_rows(const Object& object, const Camera& camera) {
  const auto image = [&](const MeshPoint& p) {
    const HomogeneousImagePoint a =
        to_image(camera.projection, to_camera(camera.world_to_camera, object.world_from_mesh(p)));
    return ExactVector3{a.U, a.V, a.W};
  };
  const ExactVector3 origin = image({0, 0, 0}), x = image({1, 0, 0}), y = image({0, 1, 0}),
                     z = image({0, 0, 1});
  std::array<std::array<Dyadic, 4>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = {x[i] - origin[i], y[i] - origin[i], z[i] - origin[i], origin[i]};
  }
  return rows;
}

namespace {

constexpr std::size_t remembered_corners = 4096;

/// The integers near an interval of the image, one more on each side, so that roundings of the ends
/// do no harm; `first` at most `count`, `last` at least −1. An unknown end (NaN) becomes the end of
/// the image.
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

namespace {

std::array<ApproximateRow, 2> rows_of(const Object& object, const Camera& camera,
                                      const ImagePoint& s) {
  const auto image = image_rows(object, camera);
  const auto difference = [&](const std::array<Dyadic, 4>& row, double place) {
    std::array<Dyadic, 4> result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = row[k] - Dyadic(place) * image[2][k];
    return ApproximateRow(result);
  };
  return {difference(image[0], s.u), difference(image[1], s.v)};
}

}  // namespace

SampleSides::SampleSides(const Object& object, const Camera& camera, const ImagePoint& s)
    : rows_(rows_of(object, camera, s)) {}

SampleSides::Sides SampleSides::of(const MeshPoint& p) const {
  unsigned sides = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Interval value = rows_[axis].at(p);
    if (value.upper < 0) sides |= 1U << (2 * axis);
    if (value.lower > 0) sides |= 2U << (2 * axis);
  }
  return static_cast<Sides>(sides);
}

}  // namespace fathom::triangle
