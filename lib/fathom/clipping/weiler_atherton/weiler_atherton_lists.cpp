#include "fathom/clipping/weiler_atherton/weiler_atherton_lists.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

/// A ring of a side passes through a point.
struct Visit {
  std::size_t point, ring, corner;
  /// Whether it is a contact: the other side passes here too.
  bool is_contact = false;
  /// The visits of the other side in whose wedges its path begins and ends.
  const Visit *begins_within = nullptr, *ends_within = nullptr;
  /// In the order along its path, at most two.
  std::vector<std::size_t> crossings = {};

  /// Whether it crosses the visit in whose wedge it begins or ends: not if both are the same visit.
  [[nodiscard]] bool crosses(const Visit* other) const {
    return other != nullptr && begins_within != ends_within;
  }
};

/// The visits of a side, point by point.
std::vector<Visit> visits_by_point(const NumberedRings& rings) {
  std::vector<Visit> visits;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) visits.push_back({rings[r][i], r, i});
  std::stable_sort(visits.begin(), visits.end(),
                   [](const Visit& a, const Visit& b) { return a.point < b.point; });
  return visits;
}

constexpr std::size_t subject_side = 0, clip_side = 1;

/// The direction from which a visit comes, or in which it leaves.
struct VisitEnd {
  std::size_t towards, side;
  Visit* visit;
  bool leaves;

  /// Among ends in one direction: the subject lies further to its left, for a union to its right.
  [[nodiscard]] int shift(SetOperation operation) const {
    if (side == clip_side) return 0;
    return leaves == (operation != SetOperation::join) ? 1 : -1;
  }
};

void add_ends(std::vector<VisitEnd>& ends, std::span<Visit> visits, const NumberedRings& rings,
              std::size_t side) {
  for (Visit& visit : visits) {
    visit.is_contact = true;
    ends.push_back({preceding(rings[visit.ring], visit.corner), side, &visit, false});
    ends.push_back({following(rings[visit.ring], visit.corner), side, &visit, true});
  }
}

/// Finds for each end the wedge of the other side in which it lies, going round counter-clockwise:
/// a wedge begins at an end that leaves, and ends at the other end of the same visit.
void place_in_wedges(const std::vector<VisitEnd>& ends) {
  std::array<Visit*, 2> wedge{};
  for (const VisitEnd& end : ends) wedge[end.side] = end.leaves ? end.visit : nullptr;
  for (const VisitEnd& end : ends) {
    Visit*& own = wedge[end.side];
    if (own != (end.leaves ? nullptr : end.visit)) refuse_what_rounding_broke();
    own = end.leaves ? end.visit : nullptr;
    (end.leaves ? end.visit->ends_within : end.visit->begins_within) = wedge[1 - end.side];
  }
}

/// The crossings at one point that both sides visit, entered in their visits; kinds of crossings
/// are appended.
class PointOfContact {
 public:
  PointOfContact(std::span<Visit> subject, std::span<Visit> clip, std::vector<ContactKind>& kinds)
      : kinds_(kinds), first_(kinds.size()) {
    for (Visit& visit : subject) {
      cross(visit, visit.begins_within, ContactKind::leaving);
      cross(visit, visit.ends_within, ContactKind::entering);
    }
    for (Visit& visit : clip)
      for (const Visit* other : {visit.begins_within, visit.ends_within})
        if (visit.crosses(other)) visit.crossings.push_back(crossing_of(*other, visit));
  }

 private:
  void cross(Visit& subject, const Visit* clip, ContactKind kind) {
    if (!subject.crosses(clip)) return;
    subject.crossings.push_back(kinds_.size());
    kinds_.push_back(kind);
    clips_.push_back(clip);
  }
  [[nodiscard]] std::size_t crossing_of(const Visit& subject, const Visit& clip) const {
    for (const std::size_t crossing : subject.crossings)
      if (clips_[crossing - first_] == &clip) return crossing;
    refuse_what_rounding_broke();
  }

  std::vector<ContactKind>& kinds_;
  std::size_t first_;
  /// The clip visit of each crossing.
  std::vector<const Visit*> clips_;
};

/// The visits of the first point in `visits`.
std::span<Visit> first_point(std::span<Visit> visits) {
  const auto end = std::find_if(visits.begin(), visits.end(), [&](const Visit& visit) {
    return visit.point != visits.front().point;
  });
  return visits.first(static_cast<std::size_t>(end - visits.begin()));
}

/// All contacts, entered in the visits. Returns the kinds of the crossings.
std::vector<ContactKind> cross(std::span<Visit> subject, std::span<Visit> clip,
                               const NumberedSides& sides, const PointOrder& points,
                               SetOperation operation) {
  std::vector<ContactKind> kinds;
  while (!subject.empty() && !clip.empty()) {
    check_interruption();
    const auto s = first_point(subject), c = first_point(clip);
    const std::size_t P = s[0].point;
    if (P == c[0].point) {
      std::vector<VisitEnd> ends;
      add_ends(ends, s, sides.subject, subject_side);
      add_ends(ends, c, sides.clip, clip_side);
      std::sort(ends.begin(), ends.end(), [&](const VisitEnd& a, const VisitEnd& b) {
        if (points.comes_before(P, a.towards, b.towards)) return true;
        return !points.comes_before(P, b.towards, a.towards) &&
               a.shift(operation) < b.shift(operation);
      });
      place_in_wedges(ends);
      PointOfContact(s, c, kinds);
    }
    if (P <= c[0].point) subject = subject.subspan(s.size());
    if (P >= c[0].point) clip = clip.subspan(c.size());
  }
  return kinds;
}

/// The edges that a side has, in order.
class EdgeSet {
 public:
  explicit EdgeSet(const NumberedRings& rings) {
    for (const auto& [from, to] : edges_of(rings)) edges_.push_back(undirected(from, to));
    std::sort(edges_.begin(), edges_.end());
  }
  [[nodiscard]] bool contains(std::size_t from, std::size_t to) const {
    return std::binary_search(edges_.begin(), edges_.end(), undirected(from, to));
  }

 private:
  std::vector<UndirectedEdge> edges_;
};

PlaceList list_of(std::vector<Visit>& visits, const NumberedRings& rings, const EdgeSet& others,
                  const std::vector<ContactKind>& kinds) {
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) {
    return std::pair(a.ring, a.corner) < std::pair(b.ring, b.corner);
  });
  PlaceList list;
  list.of_crossing.resize(kinds.size());
  for (const Visit& visit : visits) {
    for (const std::size_t crossing : visit.crossings) {
      list.of_crossing[crossing] = list.places.size();
      list.places.push_back({visit.point, visit.ring, kinds[crossing], crossing});
    }
    if (visit.crossings.empty()) {
      std::optional<ContactKind> kind;
      if (visit.is_contact)
        kind = others.contains(visit.point, following(rings[visit.ring], visit.corner))
                   ? ContactKind::along
                   : ContactKind::touching;
      list.places.push_back({visit.point, visit.ring, kind, std::nullopt});
    }
    if (visit.corner + 1 == rings[visit.ring].size()) list.rings.push_back(list.places.size());
  }
  return list;
}

/// Renumbers the crossings along the subject.
void number_along_subject(PlaceLists& lists) {
  std::vector<std::size_t> new_number(lists.subject.of_crossing.size());
  std::size_t next = 0;
  for (const Place& place : lists.subject.places)
    if (place.crossing) new_number[*place.crossing] = next++;
  for (PlaceList* list : {&lists.subject, &lists.clip})
    for (std::size_t i = 0; i < list->places.size(); ++i)
      if (auto& crossing = list->places[i].crossing) {
        crossing = new_number[*crossing];
        list->of_crossing[*crossing] = i;
      }
}

}  // namespace

std::size_t PlaceList::after(std::size_t place) const {
  const std::size_t ring = places[place].ring;
  return place + 1 < rings[ring + 1] ? place + 1 : rings[ring];
}

std::size_t PlaceList::before(std::size_t place) const {
  const std::size_t ring = places[place].ring;
  return place > rings[ring] ? place - 1 : rings[ring + 1] - 1;
}

PlaceLists enter_crossings(const NumberedSides& sides, const PointOrder& points,
                           SetOperation operation) {
  std::vector<Visit> subject = visits_by_point(sides.subject), clip = visits_by_point(sides.clip);
  const std::vector<ContactKind> kinds = cross(subject, clip, sides, points, operation);
  PlaceLists lists{list_of(subject, sides.subject, EdgeSet(sides.clip), kinds),
                   list_of(clip, sides.clip, EdgeSet(sides.subject), kinds)};
  number_along_subject(lists);
  return lists;
}

namespace {

/// The walks of one operation. A contact is `inwards` if the subject enters the result there.
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
