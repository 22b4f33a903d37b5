#include "fathom/evaluation/placed_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fathom/numeric/rounding.h"
#include "fathom/threads/threads.h"

namespace fathom::evaluation {
namespace {

/// The t with |x| < 2^t of a number that is not 0.
long top(const Dyadic& x) {
  return x.top();
}
long top(double x) {
  return std::ilogb(x) + 1L;
}

template <class Point>
long greatest_top(const Point& p, long greatest) {
  for (const auto* x : {&p.x, &p.y, &p.z})
    if (!(*x == 0)) greatest = std::max(greatest, top(*x));
  return greatest;
}

Vector rounded(const Object& object, const MeshPoint& p, long power) {
  if (object.placed_as_is) {
    const int exponent = static_cast<int>(-power);
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }
  const WorldPoint X = object.world_from_mesh(p);
  const auto round = [&](const Dyadic& x) { return round_to_binary64(Ratio(x.scaled(-power))); };
  return {round(X.x), round(X.y), round(X.z)};
}

/// The least power of a double that is not 0.
constexpr long least_power = -1100;

}  // namespace

long power_of_unit(const TriangleSource& triangles) {
  long power = least_power;
  triangles.for_each_part(0, [&](const TriangleSource::Part& part) {
    for (const MeshPoint& p : part.mesh.vertices)
      power = part.object.placed_as_is ? greatest_top(p, power)
                                       : greatest_top(part.object.world_from_mesh(p), power);
  });
  return power;
}

PlacedTriangles::PlacedTriangles(const TriangleSource& triangles, long power)
    : power_(power), corners_(triangles.count()) {
  triangles.for_each_part(0, [&](const TriangleSource::Part& part) {
    const Mesh& mesh = part.mesh;
    std::vector<Vector> vertices(mesh.vertices.size());
    parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) {
      vertices[i] = rounded(part.object, mesh.vertices[i], power);
    });
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i)
        corners_[part.first_number + t][i] = vertices[mesh.triangles[t][i]];
    }
  });
}

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
