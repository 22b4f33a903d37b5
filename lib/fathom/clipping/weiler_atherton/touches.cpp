#include "fathom/clipping/weiler_atherton/touches.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/sweep.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

/// Every edge once, in order, with the first ring that has it.
struct FirstRings {
  std::vector<UndirectedEdge> edges;
  std::vector<std::size_t> rings;

  explicit FirstRings(const NumberedRings& all) {
    std::map<UndirectedEdge, std::size_t> first;
    for (std::size_t r = 0; r < all.size(); ++r)
      for (std::size_t i = 0; i < all[r].size(); ++i)
        first.try_emplace(undirected(all[r][i], following(all[r], i)), r);
    for (const auto& [edge, ring] : first) {
      edges.push_back(edge);
      rings.push_back(ring);
    }
  }
};

/// The sweep: from corner to corner, from left to right.
class TouchSweep {
 public:
  TouchSweep(const FirstRings& all, const PointOrder& points)
      : all_(all),
        points_(points),
        line_(IsBelow{&all.edges, &points}),
        on_edge_(all.edges.size()) {}

  /// The points within each edge, from left to right.
  std::variant<std::vector<std::vector<std::size_t>>, EdgeCrossing> run() {
    auto next = std::size_t{0};  // edges are in the order of their left ends
    for (std::size_t point = 0; point < points_.size(); ++point) {
      check_interruption();
      pass(point);
      for (; next < all_.edges.size() && all_.edges[next].left == point; ++next) line_.insert(next);
      look_around(point);
      if (crossing_) return *crossing_;
    }
    return std::move(on_edge_);
  }

 private:
  using Line = std::set<std::size_t, IsBelow>;

  /// Enters the point in the edges that it lies within, and takes out those that end there.
  void pass(std::size_t point) {
    auto place = line_.lower_bound(IsBelow::Point{point});
    while (place != line_.end()) {
      const auto& [left, right] = all_.edges[*place];
      if (points_.turn(left, right, point) != 0) break;
      if (right == point) {
        place = line_.erase(place);
      } else {
        enter(*place++, point);
      }
    }
  }
  void enter(std::size_t edge, std::size_t point) {
    if (++count_ > most_contacts)
      throw InputError("the rings meet in more than " + std::to_string(most_contacts) + " points");
    on_edge_[edge].push_back(point);
  }
  /// Looks at all neighbours from the edge just below the point to the one just above. Edges that
  /// cross in the point itself are neighbours now, if not before.
  void look_around(std::size_t point) {
    auto place = line_.lower_bound(IsBelow::Point{point});
    if (place == line_.end()) return;
    auto below = place == line_.begin() ? place++ : std::prev(place);
    for (; place != line_.end(); below = place++) {
      look_at(*below, *place);
      const auto& [left, right] = all_.edges[*place];
      if (points_.turn(left, right, point) != 0) return;
    }
  }
  void look_at(std::size_t a, std::size_t b) {
    const UndirectedEdge &p = all_.edges[a], &q = all_.edges[b];
    const auto divides = [&](const UndirectedEdge& edge, const UndirectedEdge& other) {
      return points_.turn(edge.left, edge.right, other.left) *
                 points_.turn(edge.left, edge.right, other.right) <
             0;
    };
    if (divides(p, q) && divides(q, p)) cross(a, b);
  }
  void cross(std::size_t a, std::size_t b) {
    if (crossing_) return;
    if (all_.rings[b] < all_.rings[a]) std::swap(a, b);
    crossing_ = {all_.edges[a], all_.edges[b], all_.rings[a], all_.rings[b]};
  }

  const FirstRings& all_;
  const PointOrder& points_;
  Line line_;
  std::vector<std::vector<std::size_t>> on_edge_;
  std::optional<EdgeCrossing> crossing_;
  std::size_t count_ = 0;
};

}  // namespace

std::variant<NumberedRings, EdgeCrossing> enter_touches(const NumberedRings& rings,
                                                        const PointOrder& points) {
  const FirstRings all(rings);
  auto swept = TouchSweep(all, points).run();
  if (const auto* crossing = std::get_if<EdgeCrossing>(&swept)) return *crossing;
  const auto& on_edge = std::get<0>(swept);
  NumberedRings entered;
  for (const NumberedRing& ring : rings) {
    NumberedRing& corners = entered.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t from = ring[i], to = following(ring, i);
      const auto edge = std::lower_bound(all.edges.begin(), all.edges.end(), undirected(from, to));
      const auto& within = on_edge[static_cast<std::size_t>(edge - all.edges.begin())];
      corners.push_back(from);
      if (from < to)
        corners.insert(corners.end(), within.begin(), within.end());
      else
        corners.insert(corners.end(), within.rbegin(), within.rend());
    }
  }
  return entered;
}

}  // namespace fathom::clipping
