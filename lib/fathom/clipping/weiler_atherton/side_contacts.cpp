#include "fathom/clipping/weiler_atherton/side_contacts.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
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

  /// Enters the point in the edges that it lies within, and removes the edges that end there.
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
  /// Checks all neighbours from the edge just below the point to the edge just above. Edges that
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

namespace {

/// A ring passes through a point.
struct Passage {
  std::size_t point, ring, corner;
};

/// Passages through points of more than one ring, point by point, in the order of the rings.
std::vector<std::vector<Passage>> shared_points(const NumberedRings& rings, std::size_t points) {
  std::vector<std::vector<Passage>> at(points);
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const std::size_t point = rings[r][i];
      if (at[point].empty()) order.push_back(point);
      at[point].push_back({point, r, i});
    }
  std::vector<std::vector<Passage>> shared;
  for (const std::size_t point : order)
    if (at[point].size() > 1) shared.push_back(std::move(at[point]));
  return shared;
}

/// One of the two ends of a passage at its point. Directions about the point are numbered; equal
/// numbers are equal directions.
struct PassageEnd {
  std::size_t towards, passage, direction, other_direction;
};

/// Both ends of each passage, by their directions. Among ends in the same direction, ends whose
/// passage has its other end before come first, the nearest first; then the others, the farthest
/// first. So only passages that must cross are entwined.
std::vector<PassageEnd> ends_about(const std::vector<Passage>& passages, const NumberedRings& rings,
                                   const PointOrder& points) {
  std::vector<PassageEnd> ends;
  for (std::size_t v = 0; v < passages.size(); ++v) {
    const NumberedRing& ring = rings[passages[v].ring];
    ends.push_back({preceding(ring, passages[v].corner), v, 0, 0});
    ends.push_back({following(ring, passages[v].corner), v, 0, 0});
  }
  const std::size_t P = passages[0].point;
  std::sort(ends.begin(), ends.end(), [&](const PassageEnd& a, const PassageEnd& b) {
    return a.towards != b.towards && points.comes_before(P, a.towards, b.towards);
  });
  std::vector<std::size_t> sum(passages.size(), 0);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i > 0)
      ends[i].direction = ends[i - 1].direction + (ends[i].towards == ends[i - 1].towards ? 0 : 1);
    sum[ends[i].passage] += ends[i].direction;
  }
  for (PassageEnd& end : ends) end.other_direction = sum[end.passage] - end.direction;
  std::sort(ends.begin(), ends.end(), [](const PassageEnd& a, const PassageEnd& b) {
    const auto key = [](const PassageEnd& end) {
      const bool begins = end.other_direction > end.direction;
      // The passage that begins last ends first.
      return std::tuple(end.direction, begins, ~end.other_direction,
                        begins ? end.passage : ~end.passage);
    };
    return key(a) < key(b);
  });
  return ends;
}

/// Two passages of a point that cross there: their ends alternate.
std::optional<std::pair<Passage, Passage>> crossing_about(const std::vector<Passage>& passages,
                                                          const NumberedRings& rings,
                                                          const PointOrder& points) {
  check_interruption();
  std::vector<std::size_t> begun;
  for (const PassageEnd& end : ends_about(passages, rings, points)) {
    if (end.other_direction > end.direction) {
      begun.push_back(end.passage);
      continue;
    }
    if (begun.back() != end.passage)
      return std::pair(passages[begun.back()], passages[end.passage]);
    begun.pop_back();
  }
  return std::nullopt;
}

/// A ring runs along an edge from its corner to the next.
struct Run {
  std::size_t ring, corner;
};
using Runs = std::map<UndirectedEdge, std::vector<Run>>;

Runs shared_edges(const NumberedRings& rings) {
  Runs runs;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      runs[undirected(rings[r][i], following(rings[r], i))].push_back({r, i});
  std::erase_if(runs, [](const auto& item) { return item.second.size() < 2; });
  return runs;
}

/// The pieces that a ring shares with others, edge by edge.
class SharedPieces {
 public:
  SharedPieces(const NumberedRings& rings, const PointOrder& points, const Runs& runs)
      : rings_(rings), points_(points), runs_(runs) {}

  /// The crossing of `ring` with another ring along a shared piece that begins with the edge from
  /// `corner`, if there is one.
  [[nodiscard]] std::optional<RingCrossing> crossing_from(std::size_t ring,
                                                          std::size_t corner) const {
    const auto found = runs_.find(edge(ring, corner));
    if (found == runs_.end()) return std::nullopt;
    const std::size_t n = rings_[ring].size();
    for (const Run& other : found->second) {
      check_interruption();
      if (other.ring <= ring) continue;
      std::size_t first = corner, last = corner;
      if (run_along(other.ring, ring, (corner + n - 1) % n) != nullptr) continue;  // goes on
      while (run_along(other.ring, ring, (last + 1) % n) != nullptr) last = (last + 1) % n;
      if (comes_from_left(other, ring, first) !=
          comes_from_left(*run_along(other.ring, ring, last), ring, (last + 1) % n))
        return RingCrossing{ring, other.ring, rings_[ring][first]};
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] UndirectedEdge edge(std::size_t ring, std::size_t corner) const {
    return undirected(rings_[ring][corner], following(rings_[ring], corner));
  }
  /// How `other` runs along the edge of `ring` from `corner`; nullptr if it does not.
  [[nodiscard]] const Run* run_along(std::size_t other, std::size_t ring,
                                     std::size_t corner) const {
    const auto found = runs_.find(edge(ring, corner));
    if (found == runs_.end()) return nullptr;
    const auto run = std::lower_bound(found->second.begin(), found->second.end(), other,
                                      [](const Run& a, std::size_t r) { return a.ring < r; });
    return run != found->second.end() && run->ring == other ? &*run : nullptr;
  }
  /// Whether the other ring is on the left of `ring` at `corner`, where their shared piece ends;
  /// `run` is the other's part of the last edge.
  [[nodiscard]] bool comes_from_left(const Run& run, std::size_t ring, std::size_t corner) const {
    const NumberedRing &own = rings_[ring], &other = rings_[run.ring];
    const std::size_t P = own[corner];
    const std::size_t beyond = other[run.corner] == P
                                   ? preceding(other, run.corner)
                                   : following(other, (run.corner + 1) % other.size());
    return points_.is_between(P, following(own, corner), beyond, preceding(own, corner));
  }

  const NumberedRings& rings_;
  const PointOrder& points_;
  const Runs& runs_;
};

}  // namespace

std::optional<RingCrossing> ring_crossing(const NumberedRings& rings, const PointOrder& points) {
  for (const std::vector<Passage>& passages : shared_points(rings, points.size()))
    if (const auto crossing = crossing_about(passages, rings, points)) {
      const auto [a, b] = std::minmax(crossing->first.ring, crossing->second.ring);
      return RingCrossing{a, b, passages[0].point};
    }
  const Runs runs = shared_edges(rings);
  if (runs.empty()) return std::nullopt;
  const SharedPieces pieces(rings, points, runs);
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      if (const auto crossing = pieces.crossing_from(r, i)) return crossing;
  return std::nullopt;
}

namespace {

bool are_apart(const NumberedRings& split, const PointOrder& points) {
  std::size_t corners = 0;
  for (const NumberedRing& ring : split) corners += ring.size();
  return corners == points.size();
}

/// The edges without pairs of opposite edges, which cancel each other.
std::vector<DirectedEdge> border_of(const NumberedRings& rings) {
  const std::vector<DirectedEdge> all = edges_of(rings);
  std::map<UndirectedEdge, int> rising;  // how many more run from left to right
  for (const auto& [from, to] : all) rising[undirected(from, to)] += from < to ? 1 : -1;
  std::vector<DirectedEdge> border;
  for (const auto& [from, to] : all) {
    int& left = rising[undirected(from, to)];
    if ((from < to && left <= 0) || (from > to && left >= 0)) continue;
    border.push_back({from, to});
    left = 0;
  }
  return border;
}

}  // namespace

template <class Number>
Rings<Number> lists_of_side(const Rings<Number>& rings, const std::string& side) {
  Rings<Number> checked = checked_rings(rings, side);
  if (checked.size() < 2) return checked;
  const auto corners = numbered(to_exact(checked));
  const PointOrder points(corners.points);
  // Rings that were checked do not cross.
  const NumberedRings split = std::get<NumberedRings>(enter_touches(corners.rings, points));
  if (are_apart(split, points)) return checked;
  Rings<Number> lists;
  for (const NumberedRing& list : joined_by_wedges(border_of(split), points)) {
    Ring<Number>& ring = lists.emplace_back();
    for (const std::size_t corner : list) {
      const auto& [x, y] = corners.points[corner];
      if constexpr (std::is_same_v<Number, double>)
        ring.push_back({to_binary64(x), to_binary64(y)});  // a corner from before
      else
        ring.push_back({x, y});
    }
  }
  return lists;
}

template Rings<double> lists_of_side(const Rings<double>&, const std::string&);
template Rings<Rational> lists_of_side(const Rings<Rational>&, const std::string&);

}  // namespace fathom::clipping
