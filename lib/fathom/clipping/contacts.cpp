#include "fathom/clipping/contacts.h"

#include <algorithm>
#include <utility>

namespace fathom::clipping {
namespace {

template <class Number>
bool is_between(const Number& x, const Number& a, const Number& b) {
  return a < b ? a <= x && x <= b : b <= x && x <= a;
}

/// An edge, with the place where it comes from.
template <class Number>
struct PlacedEdge {
  Segment2<Number> segment;
  Number xmin, xmax;
  std::size_t ring, edge;
};

template <class Number>
std::vector<PlacedEdge<Number>> edges_by_xmin(const Rings<Number>& rings) {
  std::vector<PlacedEdge<Number>> edges;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Point2<Number>&a = rings[r][i], &b = rings[r][(i + 1) % rings[r].size()];
      edges.push_back({{a, b}, std::min(a.x, b.x), std::max(a.x, b.x), r, i});
    }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
    return a.xmin < b.xmin ||
           (a.xmin == b.xmin && std::pair(a.ring, a.edge) < std::pair(b.ring, b.edge));
  });
  return edges;
}

template <class Number>
bool y_ranges_meet(const Segment2<Number>& a, const Segment2<Number>& b) {
  return !(std::max(a.start.y, a.end.y) < std::min(b.start.y, b.end.y)) &&
         !(std::max(b.start.y, b.end.y) < std::min(a.start.y, a.end.y));
}

/// Calls visit(a, b) for every pair of edges whose bounding boxes meet.
template <class Number, class Visit>
void visit_neighbours(const Rings<Number>& rings, const Visit& visit) {
  const auto edges = edges_by_xmin(rings);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].xmin <= edges[i].xmax; ++j)
      if (y_ranges_meet(edges[i].segment, edges[j].segment)) visit(edges[i], edges[j]);
}

/// Appends the start of an edge and the contacts strictly inside it, in order along it.
template <class Number>
void append_split(Ring<Number>& ring, const Segment2<Number>& edge, Ring<Number> contacts) {
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
Rings<Number> enter_contacts(const Rings<Number>& rings) {
  std::vector<Rings<Number>> on_edge(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) on_edge[r].resize(rings[r].size());
  visit_neighbours(rings, [&](const PlacedEdge<Number>& a, const PlacedEdge<Number>& b) {
    if (a.ring == b.ring) return;
    for (const Point2<Number>& p : contacts(a.segment, b.segment)) {
      on_edge[a.ring][a.edge].push_back(p);
      on_edge[b.ring][b.edge].push_back(p);
    }
  });

  Rings<Number> split(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      append_split(split[r], {rings[r][i], rings[r][(i + 1) % rings[r].size()]},
                   std::move(on_edge[r][i]));
  return split;
}

std::optional<SelfContact> self_contact(const Ring<Rational>& ring) {
  std::optional<SelfContact> found;
  const std::size_t n = ring.size();
  visit_neighbours(Rings<Rational>{ring}, [&](const auto& a, const auto& b) {
    if (found) return;
    const bool neighbours = (a.edge + 1) % n == b.edge || (b.edge + 1) % n == a.edge;
    if (neighbours && is_plain_turn(a.segment, b.segment)) return;
    const auto points = contacts(a.segment, b.segment);
    if (!points.empty())
      found = {std::min(a.edge, b.edge), std::max(a.edge, b.edge), points.front()};
  });
  return found;
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
template Rings<double> enter_contacts(const Rings<double>&);
template Rings<Rational> enter_contacts(const Rings<Rational>&);

}  // namespace fathom::clipping
