#include "fathom/evaluation/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace fathom::evaluation {
namespace {

constexpr std::uint32_t most_in_leaf = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Growing {
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

  void add(const Vector& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], p[k]);
      box.upper[k] = std::max(box.upper[k], p[k]);
    }
  }
};

/// Three times the coordinate of a triangle's centre.
double centre(const PlacedTriangles::Corners& corners, std::size_t axis) {
  return corners[0][axis] + corners[1][axis] + corners[2][axis];
}

std::size_t longest_axis(const Box& box) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.upper[k] - box.lower[k] > box.upper[longest] - box.lower[longest]) longest = k;
  return longest;
}

}  // namespace

Box box_of(const PlacedTriangles::Corners& corners) {
  Growing around;
  for (const Vector& corner : corners) around.add(corner);
  return around.box;
}

TriangleTree::TriangleTree(const PlacedTriangles& triangles) : order_(triangles.count()) {
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  nodes_.reserve(order_.size());
  if (!order_.empty()) build(triangles, 0, triangles.count());
}

void TriangleTree::build(const PlacedTriangles& triangles, std::uint32_t begin, std::uint32_t end) {
  Growing around, centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    const PlacedTriangles::Corners& corners = triangles[order_[i]];
    for (const Vector& corner : corners) around.add(corner);
    centres.add({centre(corners, 0), centre(corners, 1), centre(corners, 2)});
  }
  const std::size_t node = nodes_.size();
  nodes_.push_back({around.box, begin, end - begin});
  if (end - begin <= most_in_leaf) return;
  const std::size_t axis = longest_axis(centres.box);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return centre(triangles[a], axis) < centre(triangles[b], axis);
                   });
  build(triangles, begin, middle);
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  build(triangles, middle, end);
}

}  // namespace fathom::evaluation
