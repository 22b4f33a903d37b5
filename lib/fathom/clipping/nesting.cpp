#include "fathom/clipping/nesting.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/contacts.h"
#include "fathom/clipping/even_odd.h"
#include "fathom/numeric/errors.h"

namespace fathom::clipping {
namespace {

enum class Place { along, inside, outside };

/// Where a ring lies with respect to another, and where it crosses it if it does.
struct Placement {
  Place place = Place::along;
  std::optional<Point2<Rational>> crossing;
};

/// A ring with its contacts entered, and the boxes of its edges.
struct BoxedRing {
  const Ring<Rational>& ring;
  std::vector<Box> edges;
  Box box;
};

BoxedRing boxed(const Ring<Rational>& ring) {
  BoxedRing result{ring, {}, box_of(ring)};
  std::vector<Box> corners;
  for (const Point2<Rational>& p : ring) corners.push_back(box_of(p));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    result.edges.push_back(corners[i]);
    result.edges.back().include(corners[(i + 1) % ring.size()]);
  }
  return result;
}

/// `other` has the box `other_box`. Without a contact, one edge tells the place of all.
Placement place_of(const BoxedRing& boxed, const EvenOdd<Rational>& other, const Box& other_box,
                   bool in_contact) {
  const Ring<Rational>& ring = boxed.ring;
  Placement placement;
  for (std::size_t i = 0; i < ring.size() && !placement.crossing; ++i) {
    Place here = Place::outside;
    // Else a part of the edge lies outside, and so all of it.
    if (other_box.may_contain(boxed.edges[i])) {
      const Beside beside = other.beside(ring[i], ring[(i + 1) % ring.size()]);
      if (beside.left != beside.right) continue;
      if (beside.left) here = Place::inside;
    }
    if (placement.place != Place::along && placement.place != here) placement.crossing = ring[i];
    placement.place = here;
    if (!in_contact) break;
  }
  return placement;
}

/// For each ring the others that have a corner in common with it.
std::vector<std::set<std::size_t>> rings_in_contact(const Rings<Rational>& split) {
  std::vector<std::pair<const Point2<Rational>*, std::size_t>> corners;
  for (std::size_t r = 0; r < split.size(); ++r)
    for (const Point2<Rational>& p : split[r]) corners.emplace_back(&p, r);
  std::sort(corners.begin(), corners.end(),
            [](const auto& a, const auto& b) { return *a.first < *b.first; });
  std::vector<std::set<std::size_t>> result(split.size());
  for (auto first = corners.begin(), last = first; first != corners.end(); first = last) {
    while (last != corners.end() && *last->first == *first->first) ++last;
    for (auto a = first; a != last; ++a)
      for (auto b = a + 1; b != last; ++b) {
        result[a->second].insert(b->second);
        result[b->second].insert(a->second);
      }
  }
  return result;
}

/// For each ring j the rings i whose place with respect to it is not known to be outside: they have
/// a contact with it, or their boxes lie in its box.
std::vector<std::vector<std::size_t>> rings_to_place(
    const std::vector<BoxedRing>& rings, const std::vector<std::set<std::size_t>>& in_contact) {
  std::vector<Box> boxes;
  boxes.reserve(rings.size());
  for (const BoxedRing& ring : rings) boxes.push_back(ring.box);
  std::vector<std::vector<std::size_t>> result(rings.size());
  for (std::size_t j = 0; j < rings.size(); ++j)
    result[j].assign(in_contact[j].begin(), in_contact[j].end());
  visit_meeting_boxes(boxes, [&](std::size_t i, std::size_t j) {
    if (boxes[j].may_contain(boxes[i])) result[j].push_back(i);
    if (boxes[i].may_contain(boxes[j])) result[i].push_back(j);
  });
  for (std::vector<std::size_t>& others : result) {
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  return result;
}

}  // namespace

std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side) {
  std::vector<int> depths(rings.size(), 0);
  if (rings.size() < 2) return depths;
  const Rings<Rational> split = enter_contacts(rings);
  const auto in_contact = rings_in_contact(split);
  std::vector<BoxedRing> boxed_rings;
  for (const Ring<Rational>& ring : split) boxed_rings.push_back(boxed(ring));
  const auto to_place = rings_to_place(boxed_rings, in_contact);
  for (std::size_t j = 0; j < rings.size(); ++j) {
    if (to_place[j].empty()) continue;
    const Rings<Rational> ring_j{split[j]};
    const EvenOdd<Rational> other(ring_j);
    for (const std::size_t i : to_place[j]) {
      if (i == j) continue;
      const Placement placement =
          place_of(boxed_rings[i], other, boxed_rings[j].box, in_contact[j].contains(i));
      if (placement.crossing)
        throw InputError(side + " rings " + std::to_string(std::min(i, j)) + " and " +
                         std::to_string(std::max(i, j)) + " cross at " +
                         to_text(*placement.crossing) + "; expected rings that at most touch");
      if (placement.place == Place::inside || (placement.place == Place::along && j < i))
        ++depths[i];
    }
  }
  return depths;
}

}  // namespace fathom::clipping
