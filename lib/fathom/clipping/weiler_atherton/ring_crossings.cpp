#include "fathom/clipping/weiler_atherton/ring_crossings.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "fathom/clipping/weiler_atherton/sweep.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

/// A ring passes through a point.
struct Passage {
  std::size_t point, ring, corner;
};

/// Passages through points that more than one ring passes, point by point, in the order in which
/// the rings come to them.
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

/// One of the two ends that a passage has at its point. Directions about the point are numbered;
/// the same number is the same direction.
struct PassageEnd {
  std::size_t towards, passage, direction, other_direction;
};

/// Both ends of each passage, by their directions. Of ends in the same direction those come first
/// whose passage has its other end before, the nearest first; then the others, the farthest first:
/// so only passages that must cross are entwined.
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
      // The last to begin is the first to end.
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

/// The pieces that one ring shares with others, edge by edge.
class SharedPieces {
 public:
  SharedPieces(const NumberedRings& rings, const PointOrder& points, const Runs& runs)
      : rings_(rings), points_(points), runs_(runs) {}

  /// Where `ring` crosses another along a piece that begins with the edge from `corner`.
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
  /// On which side of `ring` the other is where their piece ends, at `corner`; `run` is the other's
  /// part of the last edge.
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

}  // namespace fathom::clipping
