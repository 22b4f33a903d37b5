#include "fathom/evaluation/nearest_surface.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/evaluation/bounds.h"
#include "fathom/evaluation/distance_bounds.h"
#include "fathom/evaluation/exact_distance.h"

namespace fathom::evaluation {
namespace {

/// Not more than the distance of the exact point from the exact triangles in the box: each gap errs
/// by at most bounds::difference_error (validation/proofs, evaluation_gap).
double least_distance(const Box& box, const Vector& p) {
  Vector gap;
  for (std::size_t k = 0; k < 3; ++k)
    gap[k] = std::max({box.lower[k] - p[k], p[k] - box.upper[k], 0.0});
  return length(gap) - bounds::distance_error;
}

struct Candidate {
  std::uint32_t number;
  double lower;
};

/// Triangles that may be the nearest.
struct Candidates {
  std::vector<Candidate> list;
  /// The surface is not farther away.
  double upper = std::numeric_limits<double>::infinity();

  void add(std::uint32_t number, const DistanceBounds& bounds) {
    if (bounds.lower > upper) return;
    upper = std::min(upper, bounds.upper);
    list.push_back({number, bounds.lower});
  }
};

/// A node that is still to be looked at.
struct Waiting {
  std::uint32_t node;
  double lower;
};

Candidates candidates_for(const Vector& p, const PlacedTriangles& triangles,
                          const TriangleTree& tree) {
  const std::vector<TriangleTree::Node>& nodes = tree.nodes();
  Candidates candidates;
  std::vector<Waiting> waiting{{0, 0}};
  while (!waiting.empty()) {
    const auto [number, lower] = waiting.back();
    waiting.pop_back();
    if (lower > candidates.upper) continue;
    const TriangleTree::Node& node = nodes[number];
    if (node.count != 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t triangle = tree.order()[i];
        candidates.add(triangle, distance_bounds(triangles[triangle], p));
      }
      continue;
    }
    Waiting near{number + 1, least_distance(nodes[number + 1].box, p)};
    Waiting far{node.first, least_distance(nodes[node.first].box, p)};
    if (far.lower < near.lower) std::swap(near, far);
    waiting.push_back(far);
    waiting.push_back(near);
  }
  return candidates;
}

}  // namespace

Ratio NearestSurface::squared_distance(const PlacedPoint& p) const {
  const Candidates candidates = candidates_for(p.near, triangles_, tree_);
  Ratio least;
  bool found = false;
  for (const Candidate& candidate : candidates.list) {
    if (candidate.lower > candidates.upper) continue;
    Ratio squared = evaluation::squared_distance(p.exact, source_.world_corners(candidate.number));
    if (!found || squared < least) least = std::move(squared);
    found = true;
  }
  return least;
}

}  // namespace fathom::evaluation
