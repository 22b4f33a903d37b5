#include "fathom/attribution/pixels/pixel_verdict.h"

#include <algorithm>
#include <numeric>

namespace fathom::attribution {
namespace {

/// An edge that the model leaves open, directed so that its triangle lies on its left.
struct OpenEdge {
  std::uint32_t from = 0, to = 0;
  std::size_t fragment = 0;
  std::size_t partner = 0;  ///< the fragment on its other side, or itself
};

std::vector<OpenEdge> open_edges(std::span<const Fragment> fragments,
                                 std::span<const CornerIndices> triangles,
                                 const std::vector<std::uint32_t>& numbers) {
  std::vector<OpenEdge> edges;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Fragment& f = fragments[i];
    if (f.coverage != Coverage::may || f.open_edges == joins_no_other) continue;
    const CornerIndices& t = triangles[f.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if ((f.open_edges >> k & 1U) == 0) continue;
      OpenEdge edge{numbers[t[(k + 1) % 3]], numbers[t[(k + 2) % 3]], i, i};
      if (f.turned) std::swap(edge.from, edge.to);
      edges.push_back(edge);
    }
  }
  return edges;
}

/// Pairs edges of opposite direction; edges that three triangles share stay unpaired.
void pair(std::vector<OpenEdge>& edges) {
  for (OpenEdge& edge : edges) {
    std::size_t opposite = 0, same = 0;
    for (const OpenEdge& other : edges) {
      if (edge.from == other.to && edge.to == other.from) {
        ++opposite;
        edge.partner = other.fragment;
      } else if (edge.from == other.from && edge.to == other.to) {
        ++same;
      }
    }
    if (opposite != 1 || same != 1) edge.partner = edge.fragment;
  }
}

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[of(i)] = of(j); }

 private:
  std::vector<std::size_t> parent_;
};

/// The minimum, over groups that certainly cover the sample, of the group's greatest value. Such a
/// group is closed, has no unpaired open edge, and covers the sample with its exact corners.
double joint_cap(std::span<const Fragment> fragments, std::vector<OpenEdge> edges) {
  pair(edges);
  Groups groups(fragments.size());
  for (const OpenEdge& edge : edges) groups.join(edge.fragment, edge.partner);
  std::vector<bool> closed(fragments.size(), true), covered(fragments.size(), false);
  std::vector<double> greatest(fragments.size(), -std::numeric_limits<double>::infinity());
  for (const OpenEdge& edge : edges) {
    const std::size_t group = groups.of(edge.fragment);
    if (edge.partner == edge.fragment) closed[group] = false;
    const Fragment& f = fragments[edge.fragment];
    if (f.inside) covered[group] = true;
    greatest[group] = std::max(greatest[group], f.value.upper);
  }
  double cap = std::numeric_limits<double>::infinity();
  for (const OpenEdge& edge : edges) {
    const std::size_t group = groups.of(edge.fragment);
    if (closed[group] && covered[group]) cap = std::min(cap, greatest[group]);
  }
  return cap;
}

}  // namespace

PixelVerdict verdict_of(std::span<const Fragment> fragments, bool watertight,
                        std::span<const CornerIndices> triangles,
                        const std::vector<std::uint32_t>& numbers) {
  PixelVerdict verdict;
  bool some_may = false;
  for (const Fragment& f : fragments) {
    if (f.coverage == Coverage::may) some_may = true;
    if (f.coverage != Coverage::must) continue;
    verdict.must = verdict.must_if_watertight = true;
    verdict.cap = std::min(verdict.cap, f.value.upper);
  }
  if (!some_may) return verdict;
  const double together = joint_cap(fragments, open_edges(fragments, triangles, numbers));
  if (together == std::numeric_limits<double>::infinity()) return verdict;
  verdict.must_if_watertight = true;
  if (watertight) {
    verdict.must = true;
    verdict.cap = std::min(verdict.cap, together);
  }
  return verdict;
}

}  // namespace fathom::attribution
