#include "fathom/evaluation/box_tree.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>

#include "fathom/evaluation/placed_points.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::evaluation {
namespace {

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

std::uint32_t most_in_leaf(const PlacedTriangles&) {
  return 4;
}
std::uint32_t most_in_leaf(const PlacedCloud&) {
  return 8;
}

std::span<const Vector> corners_of(const PlacedTriangles& triangles, std::uint32_t number) {
  return triangles[number];
}
std::span<const Vector> corners_of(const PlacedCloud& points, std::uint32_t number) {
  return {&points[number], 1};
}

/// Three times the coordinate of a triangle's centre; the coordinate of a point.
double centre(const PlacedTriangles& triangles, std::uint32_t number, std::size_t axis) {
  const PlacedTriangles::Corners& corners = triangles[number];
  return corners[0][axis] + corners[1][axis] + corners[2][axis];
}
double centre(const PlacedCloud& points, std::uint32_t number, std::size_t axis) {
  return points[number][axis];
}

std::size_t longest_axis(const Box& box) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.upper[k] - box.lower[k] > box.upper[longest] - box.lower[longest]) longest = k;
  return longest;
}

/// Whether the elements are all equal, so that a single element is enough: a scan may contain the
/// same point a million times.
bool are_one(const PlacedTriangles&, const Box&, std::span<const std::uint32_t>) {
  return false;
}
bool are_one(const PlacedCloud& points, const Box& box, std::span<const std::uint32_t> numbers) {
  return box.lower == box.upper && std::ranges::all_of(numbers, [&](std::uint32_t number) {
           return points.are_same(numbers[0], number);
         });
}

/// How many nodes a tree of so many elements has, which halves them until no more than `most` are
/// in a leaf: all of the levels above the last one but one, and two for each node there that is
/// halved.
std::uint32_t nodes_of(std::uint32_t elements, std::uint32_t most) {
  std::uint64_t parts = 1, nodes = 1;
  // The parts of a level have elements / parts of them, or one more.
  while (elements / parts > most) {
    parts *= 2;
    nodes += parts;
  }
  const std::uint64_t longer = elements % parts;
  return static_cast<std::uint32_t>(nodes + (elements / parts == most ? 2 * longer : 0));
}

/// A smaller part of a tree is built by one thread.
constexpr std::uint32_t worth_a_thread = 10000;

}  // namespace

Box box_of(std::span<const Vector> points) {
  Growing around;
  for (const Vector& p : points) around.add(p);
  return around.box;
}

BoxTree::BoxTree(const PlacedTriangles& triangles) : order_(triangles.count()) {
  build(triangles);
}

BoxTree::BoxTree(const PlacedCloud& points) : order_(points.count()) {
  build(points);
}

template <class Elements>
void BoxTree::build(const Elements& elements) {
  if (order_.empty()) return;
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  const std::uint32_t count = elements.count();
  nodes_.resize(nodes_of(count, most_in_leaf(elements)));
  build(elements, 0, count, 0);
}

template <class Elements>
void BoxTree::build(const Elements& elements, std::uint32_t begin, std::uint32_t end,
                    std::uint32_t node) {
  Growing around, centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vector& corner : corners_of(elements, order_[i])) around.add(corner);
    centres.add({centre(elements, order_[i], 0), centre(elements, order_[i], 1),
                 centre(elements, order_[i], 2)});
  }
  nodes_[node] = {around.box, begin, end - begin};
  const std::uint32_t most = most_in_leaf(elements);
  if (end - begin <= most) return;
  if (are_one(elements, around.box, {&order_[begin], end - begin})) {
    nodes_[node].count = 1;
    return;
  }
  const std::size_t axis = longest_axis(centres.box);
  const std::uint32_t middle = begin + (end - begin) / 2;
  OccasionalInterruption interruption;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     interruption();
                     return centre(elements, a, axis) < centre(elements, b, axis);
                   });
  const std::uint32_t second = node + 1 + nodes_of(middle - begin, most);
  nodes_[node].first = second;
  nodes_[node].count = 0;
  const auto build_child = [&](std::size_t child) {
    if (child == 0) {
      build(elements, begin, middle, node + 1);
    } else {
      build(elements, middle, end, second);
    }
  };
  if (end - begin >= worth_a_thread) {
    in_parallel(2, build_child);
  } else {
    build_child(0);
    build_child(1);
  }
}

}  // namespace fathom::evaluation
