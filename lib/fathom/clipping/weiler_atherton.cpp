#include "fathom/clipping/weiler_atherton.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/contacts.h"
#include "fathom/clipping/even_odd.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton_labels.h"
#include "fathom/clipping/weiler_atherton_walk.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

/// Step 1.
template <class Number>
ContactLists<Number> enter_contacts_of(const Rings<Number>& subject, const Rings<Number>& clip) {
  Rings<Number> all = subject;
  all.insert(all.end(), clip.begin(), clip.end());
  all = enter_contacts(all);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(subject.size());
  return {{all.begin(), middle}, {middle, all.end()}};
}

bool in_result(bool in_subject, bool in_clip, SetOperation operation) {
  return operation == SetOperation::intersection ? in_subject && in_clip : in_subject && !in_clip;
}

/// The edge as a piece of the result's border; nullopt if the result lies on both sides of it or on
/// neither. So a subject edge counts where it is inside (outside, for a difference), a clip edge
/// where it is inside the subject (reversed, for a difference), a shared one depending on whether
/// both polygons lie on the same side of it.
template <class Number>
std::optional<BorderEdge<Number>> border_of(const LabelledEdge<Number>& edge,
                                            SetOperation operation) {
  const bool left = in_result(edge.of_subject.left, edge.of_clip.left, operation);
  const bool right = in_result(edge.of_subject.right, edge.of_clip.right, operation);
  if (left == right) return std::nullopt;
  if (left) return BorderEdge<Number>{edge.from, edge.to, edge.border};
  return BorderEdge<Number>{edge.to, edge.from, edge.border};
}

/// The border of the result. Subject edges that begin at an entering contact come first: the walk
/// starts there, as in the paper.
template <class Number>
std::vector<BorderEdge<Number>> border_of(const std::vector<LabelledEdge<Number>>& edges,
                                          const std::vector<Contact<Number>>& contacts,
                                          SetOperation operation) {
  std::vector<BorderEdge<Number>> border;
  for (const LabelledEdge<Number>& edge : edges)
    if (const auto piece = border_of(edge, operation)) border.push_back(*piece);
  const ContactKind start =
      operation == SetOperation::intersection ? ContactKind::entering : ContactKind::leaving;
  std::set<Point2<Number>> starts;
  for (const Contact<Number>& contact : contacts)
    if (contact.kind == start) starts.insert(contact.point);
  std::stable_partition(border.begin(), border.end(), [&](const BorderEdge<Number>& edge) {
    return edge.along != Border::clip && starts.contains(edge.from);
  });
  return border;
}

/// A ring that holes may lie in.
template <class Number>
class Outline {
 public:
  explicit Outline(const Ring<Number>& ring, Number area)
      : rings_{ring}, area_(std::move(area)), box_(box_of(ring)) {}

  [[nodiscard]] const Ring<Number>& ring() const { return rings_[0]; }
  [[nodiscard]] const Number& area() const { return area_; }
  bool contains(const Ring<Number>& hole, const Box& hole_box) {
    if (!box_.may_contain(hole_box)) return false;
    if (!inside_) inside_.emplace(rings_);
    return inside_->beside(hole[0], hole[1]).left;
  }

 private:
  Rings<Number> rings_;
  Number area_;
  Box box_;
  std::optional<EvenOdd<Number>> inside_;
};

/// Step 4: each hole goes to the least outline that contains it. The rings still have the corners
/// at which they touch others, so the middle of a hole's edge lies on no outline.
template <class Number>
std::vector<Polygon<Number>> nest(const Rings<Number>& rings) {
  std::deque<Outline<Number>> outlines;  // each keeps its place
  std::vector<const Ring<Number>*> holes;
  for (const Ring<Number>& ring : rings) {
    Number area = signed_area(ring);
    if (area < 0) holes.push_back(&ring);
    if (area > 0) outlines.emplace_back(ring, std::move(area));
  }
  std::vector<Polygon<Number>> polygons;
  for (const Outline<Number>& outline : outlines) polygons.push_back({outline.ring(), {}});
  for (const Ring<Number>* hole : holes) {
    const Box box = box_of(*hole);
    std::optional<std::size_t> around;
    for (std::size_t i = 0; i < outlines.size(); ++i)
      if (outlines[i].contains(*hole, box) &&
          (!around || outlines[i].area() < outlines[*around].area()))
        around = i;
    if (!around)
      throw InputError(
          "rounding to binary64 has left a hole without an outline; the exact kernel does it");
    polygons[*around].holes.push_back(*hole);
  }
  return polygons;
}

template <class Number>
std::vector<Polygon<Number>> in_canonical_order(std::vector<Polygon<Number>> polygons) {
  for (Polygon<Number>& polygon : polygons) {
    polygon.outline = canonical(polygon.outline);
    for (Ring<Number>& hole : polygon.holes) hole = canonical(hole);
    std::sort(polygon.holes.begin(), polygon.holes.end());
  }
  std::sort(polygons.begin(), polygons.end(),
            [](const auto& a, const auto& b) { return a.outline < b.outline; });
  return polygons;
}

template <class Number>
std::vector<WalkStep<Number>> steps_of(const std::vector<BorderEdge<Number>>& closed_walk) {
  std::vector<WalkStep<Number>> steps;
  steps.reserve(closed_walk.size());
  for (const BorderEdge<Number>& edge : closed_walk) steps.push_back({edge.from, edge.along});
  return steps;
}

}  // namespace

template <class Number>
std::vector<Polygon<Number>> weiler_atherton(const Rings<Number>& subject_rings,
                                             const Rings<Number>& clip_rings,
                                             SetOperation operation,
                                             WeilerAthertonTrace<Number>* trace) {
  const StandardArithmetic standard;
  const Rings<Number> subject = checked_rings(subject_rings, "subject");
  const Rings<Number> clip = checked_rings(clip_rings, "clip");

  const ContactLists<Number> lists = enter_contacts_of(subject, clip);
  const auto edges = label_edges(lists);
  const auto contacts = label_contacts(lists);
  const auto walks = walk(border_of(edges, contacts, operation));
  Rings<Number> rings;
  for (const auto& closed_walk : walks)
    for (Ring<Number>& ring : simple_rings(closed_walk)) rings.push_back(std::move(ring));

  if (trace != nullptr) {
    trace->contacts = contacts;
    for (const auto& closed_walk : walks) trace->walks.push_back(steps_of(closed_walk));
  }
  return in_canonical_order(nest(rings));
}

template <class Number>
Number area_of(const std::vector<Polygon<Number>>& polygons) {
  const StandardArithmetic standard;
  std::vector<Number> areas;
  for (const Polygon<Number>& polygon : polygons)
    areas.push_back(signed_area(polygon.outline) + signed_area(polygon.holes));
  return sum_of(std::move(areas));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                                                             \
  template std::vector<Polygon<Number>> weiler_atherton(                                       \
      const Rings<Number>&, const Rings<Number>&, SetOperation, WeilerAthertonTrace<Number>*); \
  template Number area_of(const std::vector<Polygon<Number>>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
