#include "fathom/clipping/weiler_atherton_labels.h"

#include <map>
#include <set>
#include <utility>

#include "fathom/clipping/exact_kernel.h"

namespace fathom::clipping {
namespace {

/// Edges are the same in either direction.
template <class Number>
using EdgeKey = std::pair<Point2<Number>, Point2<Number>>;

template <class Number>
EdgeKey<Number> key_of(const Point2<Number>& a, const Point2<Number>& b) {
  return a < b ? EdgeKey<Number>{a, b} : EdgeKey<Number>{b, a};
}

template <class Number, class Visit>
void visit_edges(const Rings<Number>& rings, const Visit& visit) {
  for (const Ring<Number>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
}

Relation relation_of(Beside beside) {
  if (beside.left != beside.right) return Relation::along;
  return beside.left ? Relation::inside : Relation::outside;
}

/// The kind of a contact. `came_from` is the last relation before it that was not along: at the end
/// of a shared piece it decides whether the subject has changed sides.
ContactKind kind_of(Relation came_from, Relation after) {
  if (after == Relation::along) return ContactKind::along;
  if (came_from == after) return ContactKind::touching;
  return after == Relation::inside ? ContactKind::entering : ContactKind::leaving;
}

/// For each edge of a closed list the last relation before it that is not along; along if there is
/// none.
std::vector<Relation> last_sides(const std::vector<Relation>& relations) {
  std::vector<Relation> result(relations.size());
  Relation last = Relation::along;
  for (int round = 0; round < 2; ++round) {  // the second knows how the first ended
    for (std::size_t i = 0; i < relations.size(); ++i) {
      result[i] = last;
      if (relations[i] != Relation::along) last = relations[i];
    }
  }
  return result;
}

}  // namespace

template <class Number>
std::vector<LabelledEdge<Number>> label_edges(const ContactLists<Number>& lists) {
  const EvenOdd<Number> subject(lists.subject), clip(lists.clip);
  std::vector<LabelledEdge<Number>> edges;
  std::map<EdgeKey<Number>, std::size_t> numbers;
  const auto enter = [&](Border border) {
    return [&, border](const Point2<Number>& from, const Point2<Number>& to) {
      const auto [place, is_new] = numbers.try_emplace(key_of(from, to), edges.size());
      if (!is_new) {
        Border& known = edges[place->second].border;
        if (known != border) known = Border::both;
        return;
      }
      edges.push_back({from, to, border, subject.beside(from, to), clip.beside(from, to)});
    };
  };
  visit_edges(lists.subject, enter(Border::subject));
  visit_edges(lists.clip, enter(Border::clip));
  return edges;
}

template <class Number>
std::vector<Contact<Number>> label_contacts(const ContactLists<Number>& lists) {
  std::set<Point2<Number>> clip_points;
  visit_edges(lists.clip, [&](const auto& from, const auto&) { clip_points.insert(from); });

  const EvenOdd<Number> clip(lists.clip);
  std::vector<Contact<Number>> contacts;
  for (std::size_t r = 0; r < lists.subject.size(); ++r) {
    const Ring<Number>& ring = lists.subject[r];
    const std::size_t n = ring.size();
    std::vector<Relation> relations;
    for (std::size_t i = 0; i < n; ++i)
      relations.push_back(relation_of(clip.beside(ring[i], ring[(i + 1) % n])));
    const std::vector<Relation> came_from = last_sides(relations);
    for (std::size_t i = 0; i < n; ++i)
      if (clip_points.contains(ring[i]))
        contacts.push_back({r, ring[i], relations[(i + n - 1) % n], relations[i],
                            kind_of(came_from[i], relations[i])});
  }
  return contacts;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                                                     \
  template std::vector<LabelledEdge<Number>> label_edges(const ContactLists<Number>&); \
  template std::vector<Contact<Number>> label_contacts(const ContactLists<Number>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
