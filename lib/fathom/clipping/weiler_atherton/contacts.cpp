#include "fathom/clipping/weiler_atherton/contacts.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "fathom/clipping/boxes.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

template <class Number>
bool is_between(const Number& x, const Number& a, const Number& b) {
  return a < b ? a <= x && x <= b : b <= x && x <= a;
}

/// An edge, with its origin.
template <class Number>
struct PlacedEdge {
  Segment2<Number> segment;
  Box at_start, at_end;
  std::size_t ring, edge;

  [[nodiscard]] Box box() const {
    Box box = at_start;
    box.include(at_end);
    return box;
  }
};

/// The edges, by their least abscissas.
template <class Number>
std::vector<PlacedEdge<Number>> edges_by_xmin(const Rings<Number>& rings) {
  std::vector<PlacedEdge<Number>> edges;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      check_interruption();
      const Point2<Number>&a = rings[r][i], &b = rings[r][(i + 1) % rings[r].size()];
      edges.push_back({{a, b}, box_of(a), box_of(b), r, i});
    }
  const auto xmin = [](const Segment2<Number>& s) -> const Number& {
    return std::min(s.start.x, s.end.x);
  };
  OccasionalInterruption check;
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
    check();
    const Number &a_min = xmin(a.segment), &b_min = xmin(b.segment);
    return a_min < b_min ||
           (a_min == b_min && std::pair(a.ring, a.edge) < std::pair(b.ring, b.edge));
  });
  return edges;
}

template <class Number>
bool is_one_sided(const PlacedEdge<Number>& a, const PlacedEdge<Number>& b) {
  const auto start = settled_sign_of_cross(a.at_start, a.at_end, b.at_start);
  const auto end = settled_sign_of_cross(a.at_start, a.at_end, b.at_end);
  return start && end && *start * *end > 0;
}

/// Whether an edge lies strictly on one side of the other, if a quick test settles it.
template <class Number>
bool are_apart(const PlacedEdge<Number>& a, const PlacedEdge<Number>& b) {
  return is_one_sided(a, b) || is_one_sided(b, a);
}

/// contacts(a, b) of edges whose boxes meet. Over double, rounded numbers decide whether and where
/// they meet.
template <class Number>
std::vector<Point2<Number>> contacts_of(const PlacedEdge<Number>& a, const PlacedEdge<Number>& b) {
  if (std::is_same_v<Number, Rational> && are_apart(a, b)) return {};
  return contacts(a.segment, b.segment);
}

/// Whether edges with a common corner have no other point in common, if a quick test settles it.
template <class Number>
bool meet_in_an_end_at_most(const PlacedEdge<Number>& a, const PlacedEdge<Number>& b) {
  const auto is_at = [](const Box& p, const Box& q) {
    return p.is_exact() && p.x == q.x && p.y == q.y;
  };
  const auto turns = [&](const Box& other) {
    return settled_sign_of_cross(a.at_start, a.at_end, other).value_or(0) != 0;
  };
  if (is_at(a.at_start, b.at_start) || is_at(a.at_end, b.at_start)) return turns(b.at_end);
  if (is_at(a.at_start, b.at_end) || is_at(a.at_end, b.at_end)) return turns(b.at_start);
  return false;
}

/// A CGAL kernel for is_simple_2(), whose predicates check for interruptions.
template <class Kernel>
class InterruptibleTraits {
 public:
  template <class Predicate>
  struct InterruptiblePredicate : Predicate {
    OccasionalInterruption* check;
    template <class... Points>
    auto operator()(const Points&... points) const {
      (*check)();
      return Predicate::operator()(points...);
    }
  };
  using Point_2 = typename Kernel::Point_2;
  using Less_xy_2 = InterruptiblePredicate<typename Kernel::Less_xy_2>;
  using Orientation_2 = InterruptiblePredicate<typename Kernel::Orientation_2>;

  explicit InterruptibleTraits(OccasionalInterruption& check) : check_(&check) {}
  [[nodiscard]] Less_xy_2 less_xy_2_object() const { return {{}, check_}; }
  [[nodiscard]] Orientation_2 orientation_2_object() const { return {{}, check_}; }

 private:
  OccasionalInterruption* check_;
};

/// Whether the ring meets itself nowhere.
template <class Kernel, class ToPoint>
bool is_simple(const Ring<Rational>& ring, const ToPoint& to_point) {
  std::vector<typename Kernel::Point_2> corners;
  corners.reserve(ring.size());
  for (const Point2<Rational>& p : ring) corners.push_back(to_point(p));
  OccasionalInterruption check;
  return CGAL::is_simple_2(corners.begin(), corners.end(), InterruptibleTraits<Kernel>(check));
}

bool is_simple(const Ring<Rational>& ring) {
  using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Exact = CGAL::Simple_cartesian<Rational>;
  const bool known =
      std::all_of(ring.begin(), ring.end(), [](const auto& p) { return box_of(p).is_exact(); });
  if (known)
    return is_simple<Filtered>(ring, [](const auto& p) {
      const Box at = box_of(p);
      return Filtered::Point_2(at.x.least, at.y.least);
    });
  return is_simple<Exact>(ring, [](const auto& p) { return Exact::Point_2(p.x, p.y); });
}

/// Calls visit(i, k) for edges of different sides whose boxes meet.
template <class Number, class Visit>
void visit_meeting_edges(const std::vector<PlacedEdge<Number>>& edges, std::size_t first_of_clip,
                         const Visit& visit) {
  std::vector<Box> boxes[2];
  std::vector<std::size_t> numbers[2];
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::size_t side = edges[i].ring >= first_of_clip ? 1 : 0;
    boxes[side].push_back(edges[i].box());
    numbers[side].push_back(i);
  }
  visit_meeting_boxes(boxes[0], boxes[1],
                      [&](std::size_t i, std::size_t k) { visit(numbers[0][i], numbers[1][k]); });
}

/// For each edge of each ring its contacts with rings of the other side.
template <class Number>
std::vector<Rings<Number>> contacts_on_edges(const Rings<Number>& rings,
                                             std::size_t first_of_clip) {
  std::vector<Rings<Number>> on_edge(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) on_edge[r].resize(rings[r].size());
  const auto edges = edges_by_xmin(rings);
  std::size_t count = 0;
  visit_meeting_edges(edges, first_of_clip, [&](std::size_t i, std::size_t k) {
    check_interruption();
    // Over double the order of the arguments matters.
    const PlacedEdge<Number>&a = edges[std::min(i, k)], &b = edges[std::max(i, k)];
    if (std::is_same_v<Number, Rational> && meet_in_an_end_at_most(a, b)) return;
    for (const Point2<Number>& p : contacts_of(a, b)) {
      for (const auto* edge : {&a, &b}) {
        // At its ends it is divided already.
        if (p == edge->segment.start || p == edge->segment.end) continue;
        if (++count > most_contacts)
          throw InputError("the rings meet in more than " + std::to_string(most_contacts) +
                           " points");
        on_edge[edge->ring][edge->edge].push_back(p);
      }
    }
  });
  return on_edge;
}

/// Appends the start of an edge and the contacts strictly inside it, in order along it.
template <class Number>
void append_split(Ring<Number>& ring, const Segment2<Number>& edge, Ring<Number> contacts) {
  check_interruption();
  const Point2<Number>&start = edge.start, &end = edge.end;
  const bool ascending = start < end;
  const auto comes_before = [&](const Point2<Number>& a, const Point2<Number>& b) {
    return ascending ? a < b : b < a;
  };
  // Rounding can put a contact beyond an end.
  std::erase_if(contacts, [&](const Point2<Number>& p) {
    return !comes_before(start, p) || !comes_before(p, end);
  });
  std::sort(contacts.begin(), contacts.end(), comes_before);
  contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  ring.push_back(start);
  ring.insert(ring.end(), contacts.begin(), contacts.end());
}

/// The rings with their edges divided at the contacts on them.
template <class Number>
Rings<Number> divided(const Rings<Number>& rings, std::vector<Rings<Number>> on_edge) {
  Rings<Number> split(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      append_split(split[r], {rings[r][i], rings[r][(i + 1) % rings[r].size()]},
                   std::move(on_edge[r][i]));
  return split;
}

/// Whether neighbouring edges continue each other without turning back.
bool is_plain_turn(const Segment2<Rational>& a, const Segment2<Rational>& b) {
  const auto turn = [](const auto& in, const auto& out) {
    const Rational dot = (in.end.x - in.start.x) * (out.end.x - out.start.x) +
                         (in.end.y - in.start.y) * (out.end.y - out.start.y);
    return cross(in.start, in.end, out.end) != 0 || dot > 0;
  };
  return a.end == b.start ? turn(a, b) : turn(b, a);
}

}  // namespace

template <class Number>
std::vector<Point2<Number>> contacts(const Segment2<Number>& a, const Segment2<Number>& b) {
  const auto side = [](const Segment2<Number>& s, const Point2<Number>& p) {
    return cross(s.start, s.end, p);
  };
  const Number a0 = side(b, a.start), a1 = side(b, a.end);
  const Number b0 = side(a, b.start), b1 = side(a, b.end);
  if constexpr (std::is_same_v<Number, double>) {
    if (!std::isfinite(a0 - a1) || !std::isfinite(b0 - b1))
      throw InputError("where edges meet is beyond binary64; the exact kernel does it");
  }
  if (sign_of(a0) * sign_of(a1) < 0 && sign_of(b0) * sign_of(b1) < 0)
    return {interpolate(a.start, a.end, Number(a0 / (a0 - a1)))};

  std::vector<Point2<Number>> points;
  const auto enter_if_on = [&](const Point2<Number>& p, const Number& p_side,
                               const Segment2<Number>& s) {
    if (p_side == 0 && is_between(p.x, s.start.x, s.end.x) && is_between(p.y, s.start.y, s.end.y))
      points.push_back(p);
  };
  enter_if_on(a.start, a0, b);
  enter_if_on(a.end, a1, b);
  enter_if_on(b.start, b0, a);
  enter_if_on(b.end, b1, a);
  return points;
}

template <class Number>
Sides<Number> enter_contacts(const Sides<Number>& sides) {
  Rings<Number> all = sides.subject;
  all.insert(all.end(), sides.clip.begin(), sides.clip.end());
  all = divided(all, contacts_on_edges(all, sides.subject.size()));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(sides.subject.size());
  return {{all.begin(), middle}, {middle, all.end()}};
}

std::optional<SelfContact> self_contact(const Ring<Rational>& ring) {
  if (is_simple(ring)) return std::nullopt;
  const std::size_t n = ring.size();
  const auto edges = edges_by_xmin(Rings<Rational>{ring});
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Box box = edges[i].box();
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      check_interruption();
      const Box other = edges[k].box();
      if (box.x.is_below(other.x)) break;
      if (!box.meets(other)) continue;
      const auto &a = edges[i], &b = edges[k];
      const bool neighbours = (a.edge + 1) % n == b.edge || (b.edge + 1) % n == a.edge;
      if (neighbours && is_plain_turn(a.segment, b.segment)) continue;
      const auto points = contacts_of(a, b);
      if (!points.empty())
        return SelfContact{std::min(a.edge, b.edge), std::max(a.edge, b.edge), points.front()};
    }
  }
  return std::nullopt;
}

std::string to_text(const Point2<Rational>& point) {
  constexpr std::size_t longest = 24;
  const auto text = [](const Rational& x) {
    const std::string fraction = to_fraction(x);
    return fraction.size() <= longest ? fraction : to_decimal(to_ratio(x), 17);
  };
  return "(" + text(point.x) + ", " + text(point.y) + ")";
}

template std::vector<Point2<double>> contacts(const Segment2<double>&, const Segment2<double>&);
template std::vector<Point2<Rational>> contacts(const Segment2<Rational>&,
                                                const Segment2<Rational>&);
template Sides<double> enter_contacts(const Sides<double>&);
template Sides<Rational> enter_contacts(const Sides<Rational>&);

}  // namespace fathom::clipping
