#include "fathom/clipping/weiler_atherton/weiler_atherton_walk.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "fathom/clipping/weiler_atherton/sweep.h"
#include "fathom/clipping/weiler_atherton/wedges.h"

namespace fathom::clipping {
namespace {

/// The walks of one operation. A contact is `inwards` where the subject comes into the result.
class Walker {
 public:
  Walker(const PlaceLists& lists, SetOperation operation)
      : lists_(lists),
        operation_(operation),
        inwards_(operation == SetOperation::intersection ? ContactKind::entering
                                                         : ContactKind::leaving),
        walked_(lists.subject.of_crossing.size(), false) {}

  std::vector<Walk> all() {
    std::vector<Walk> walks;
    for (std::size_t place = 0; place < lists_.subject.places.size(); ++place) {
      const Place& start = lists_.subject.places[place];
      if (start.crossing && start.kind == inwards_ && !walked_[*start.crossing])
        walks.push_back(from(*start.crossing));
    }
    return walks;
  }

 private:
  Walk from(std::size_t start) {
    Walk walk;
    std::size_t crossing = start;
    do {
      if (walked_[crossing]) refuse_what_rounding_broke();
      walked_[crossing] = true;
      crossing = follow(walk, Border::subject, crossing, false);
      crossing = follow(walk, Border::clip, crossing, true);
    } while (crossing != start);
    return walk;
  }

  /// Walks along a list from one crossing to the next, which must be the other way.
  std::size_t follow(Walk& walk, Border along, std::size_t crossing, bool to_inwards) const {
    const PlaceList& list = along == Border::subject ? lists_.subject : lists_.clip;
    const bool backwards = along == Border::clip && operation_ == SetOperation::difference;
    std::size_t place = list.of_crossing[crossing];
    do {
      walk.push_back({along, place});
      place = backwards ? list.before(place) : list.after(place);
    } while (!list.places[place].crossing);
    if ((list.places[place].kind == inwards_) != to_inwards) refuse_what_rounding_broke();
    return *list.places[place].crossing;
  }

  const PlaceLists& lists_;
  SetOperation operation_;
  ContactKind inwards_;
  std::vector<bool> walked_;
};

/// Whether edges of either side belong to the result, by whether they lie inside the other polygon.
class Insides {
 public:
  Insides(const NumberedSides& sides, const PointOrder& points) {
    std::map<UndirectedEdge, Parities> borders;
    for (const auto& [from, to] : edges_of(sides.subject)) {
      Parities& parities = borders[undirected(from, to)];
      parities.subject = !parities.subject;
    }
    for (const auto& [from, to] : edges_of(sides.clip)) {
      Parities& parities = borders[undirected(from, to)];
      parities.clip = !parities.clip;
      clip_edges_.insert({from, to});
    }
    std::vector<UndirectedEdge> edges;
    edges.reserve(borders.size());
    for (const auto& [edge, parities] : borders) edges.push_back(edge);
    std::vector<Parities> above(edges.size());
    for (const auto& [edge, next_below] : sweep(edges, points)) {
      const Parities below = next_below ? above[*next_below] : Parities{};
      const Parities& border = borders[edges[edge]];
      above[edge] = {below.subject != border.subject, below.clip != border.clip};
      below_.insert({edges[edge], {below, border.subject && border.clip}});
    }
  }

  [[nodiscard]] bool subject_belongs(std::size_t from, std::size_t to,
                                     SetOperation operation) const {
    const auto& [below, is_shared] = below_.at(undirected(from, to));
    if (is_shared)
      return clip_edges_.contains({from, to}) != (operation == SetOperation::difference);
    return below.clip == (operation == SetOperation::intersection);
  }
  [[nodiscard]] bool clip_belongs(std::size_t from, std::size_t to, SetOperation operation) const {
    const auto& [below, is_shared] = below_.at(undirected(from, to));
    return !is_shared && below.subject == (operation != SetOperation::join);
  }

 private:
  struct Parities {
    bool subject = false, clip = false;
  };
  struct Below {
    Parities parities;
    bool is_shared;
  };
  std::map<UndirectedEdge, Below> below_;
  std::set<std::pair<std::size_t, std::size_t>> clip_edges_;
};

/// The rings of a list that nothing crosses, as walks.
template <class IsWanted>
void append_whole_rings(std::vector<Walk>& walks, const PlaceList& list, Border along,
                        bool backwards, const IsWanted& is_wanted) {
  for (std::size_t r = 0; r + 1 < list.rings.size(); ++r) {
    const std::size_t first = list.rings[r], end = list.rings[r + 1];
    const auto is_crossed = [&](std::size_t place) { return list.places[place].crossing; };
    Walk walk;
    bool crossed = false;
    for (std::size_t place = first; place < end && !crossed; ++place) {
      crossed = is_crossed(place).has_value();
      walk.push_back({along, place});
    }
    if (crossed || !is_wanted(list.places[first].point, list.places[first + 1].point)) continue;
    if (backwards) std::reverse(walk.begin(), walk.end());
    walks.push_back(std::move(walk));
  }
}

bool has_whole_rings(const PlaceList& list) {
  std::vector<bool> crossed(list.rings.size() - 1, false);
  for (const Place& place : list.places)
    if (place.crossing) crossed[place.ring] = true;
  return std::find(crossed.begin(), crossed.end(), false) != crossed.end();
}

}  // namespace

std::vector<Walk> walk(const PlaceLists& lists, SetOperation operation) {
  return Walker(lists, operation).all();
}

std::vector<Walk> whole_rings(const PlaceLists& lists, const NumberedSides& sides,
                              const PointOrder& points, SetOperation operation) {
  std::vector<Walk> walks;
  if (!has_whole_rings(lists.subject) && !has_whole_rings(lists.clip)) return walks;
  const Insides insides(sides, points);
  append_whole_rings(walks, lists.subject, Border::subject, false,
                     [&](std::size_t from, std::size_t to) {
                       return insides.subject_belongs(from, to, operation);
                     });
  append_whole_rings(
      walks, lists.clip, Border::clip, operation == SetOperation::difference,
      [&](std::size_t from, std::size_t to) { return insides.clip_belongs(from, to, operation); });
  return walks;
}

}  // namespace fathom::clipping
