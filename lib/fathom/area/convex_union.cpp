#include "fathom/area/convex_union.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "fathom/threads/interruption.h"

namespace fathom::area {
namespace {

/// A part of the line of an edge, between two crossings.
struct Part {
  const HalfPlane* from;
  const HalfPlane* to;
};

enum class Contact { inside, along_same_side, along_other_side };

struct Overlap {
  Part part;
  /// Whether the part's points lie inside the polygon, or on an edge of it.
  Contact contact = Contact::inside;
};

bool is_before(const HalfPlane& e, const HalfPlane& m, const HalfPlane& n, TierCounts& counts) {
  return &m != &n && compare_crossings(e, m, n, counts) == Sign::negative;
}

/// The part of a part of e's line that lies in the polygon, if it has a length.
std::optional<Overlap> overlap(const HalfPlane& e, const Part& part, const ConvexPolygon& polygon,
                               TierCounts& counts) {
  Overlap result{part};
  for (const HalfPlane* m : polygon.edges()) {
    switch (sign_of_turn(e, *m, counts)) {
      case Sign::zero: {
        const Sign side = side_of_crossing(*m, e, *part.from, counts);
        if (side == Sign::negative) return std::nullopt;
        if (side == Sign::zero) {
          result.contact = same_side(e, *m) ? Contact::along_same_side : Contact::along_other_side;
        }
        continue;
      }
      case Sign::negative:
        if (is_before(e, *result.part.from, *m, counts)) result.part.from = m;
        break;
      case Sign::positive:
        if (is_before(e, *m, *result.part.to, counts)) result.part.to = m;
        break;
    }
    if (!is_before(e, *result.part.from, *result.part.to, counts)) return std::nullopt;
  }
  return result;
}

/// Adds to `boundary` a part of e's line minus its hidden parts.
void add_rest(const HalfPlane& e, const Part& part, std::vector<Part>& hidden, bool reversed,
              Boundary& boundary, TierCounts& counts) {
  std::sort(hidden.begin(), hidden.end(),
            [&](const Part& a, const Part& b) { return is_before(e, *a.from, *b.from, counts); });
  const HalfPlane* reached = part.from;
  for (const Part& h : hidden) {
    if (is_before(e, *reached, *h.from, counts))
      boundary.push_back({&e, reached, h.from, reversed});
    if (is_before(e, *reached, *h.to, counts)) reached = h.to;
  }
  if (is_before(e, *reached, *part.to, counts)) {
    boundary.push_back({&e, reached, part.to, reversed});
  }
}

/// Adds the edges of polygon i that no other polygon hides: neither by points inside it, nor by an
/// edge on the other side, nor, so that such an edge counts once, by an earlier polygon's edge on
/// the same side. If there is a subject, only the parts inside it, reversed.
void add_edges(std::span<const ConvexPolygon> polygons, std::size_t i, const ConvexPolygon* subject,
               Boundary& boundary, TierCounts& counts) {
  const ConvexPolygon& polygon = polygons[i];
  std::vector<Part> hidden;
  for (std::size_t k = 0; k < polygon.edges().size(); ++k) {
    const HalfPlane& e = *polygon.edges()[k];
    Part part{&polygon.before(k), &polygon.after(k)};
    if (subject) {
      const auto within = overlap(e, part, *subject, counts);
      // Along an edge of the subject, that edge is the boundary, or nothing is.
      if (!within || within->contact != Contact::inside) continue;
      part = within->part;
    }
    hidden.clear();
    check_interruption();
    for (std::size_t j = 0; j < polygons.size(); ++j) {
      if (j == i || !polygon.bounds().may_meet(polygons[j].bounds())) continue;
      const auto by_j = overlap(e, part, polygons[j], counts);
      if (by_j && !(by_j->contact == Contact::along_same_side && j > i)) {
        hidden.push_back(by_j->part);
      }
    }
    add_rest(e, part, hidden, subject != nullptr, boundary, counts);
  }
}

/// Adds the edges of the subject, except where a polygon lies on their inside.
void add_edges_of_subject(const ConvexPolygon& subject, std::span<const ConvexPolygon> polygons,
                          Boundary& boundary, TierCounts& counts) {
  std::vector<Part> hidden;
  for (std::size_t k = 0; k < subject.edges().size(); ++k) {
    const HalfPlane& e = *subject.edges()[k];
    const Part part{&subject.before(k), &subject.after(k)};
    hidden.clear();
    for (const ConvexPolygon& polygon : polygons) {
      if (!subject.bounds().may_meet(polygon.bounds())) continue;
      const auto by_polygon = overlap(e, part, polygon, counts);
      if (by_polygon && by_polygon->contact != Contact::along_other_side) {
        hidden.push_back(by_polygon->part);
      }
    }
    add_rest(e, part, hidden, false, boundary, counts);
  }
}

}  // namespace

Boundary boundary_of(const ConvexPolygon& polygon) {
  Boundary boundary;
  for (std::size_t k = 0; k < polygon.edges().size(); ++k) {
    boundary.push_back({polygon.edges()[k], &polygon.before(k), &polygon.after(k), false});
  }
  return boundary;
}

Boundary boundary_of_union(std::span<const ConvexPolygon> polygons, TierCounts& counts) {
  Boundary boundary;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    add_edges(polygons, i, nullptr, boundary, counts);
  }
  return boundary;
}

Boundary boundary_of_difference(const ConvexPolygon& subject,
                                std::span<const ConvexPolygon> polygons, TierCounts& counts) {
  Boundary boundary;
  add_edges_of_subject(subject, polygons, boundary, counts);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    add_edges(polygons, i, &subject, boundary, counts);
  }
  return boundary;
}

// Green's theorem: the area is ½·Σ p × q over the segments from p to q. On the line
// e: e_u·u + e_v·v + e_w = 0, q = p + (τ(to) − τ(from))·(e_v, −e_u), so that
// p × q = (τ(to) − τ(from))·e_w, with the τ of compare_crossings().
std::vector<Ratio> terms_of_area(const Boundary& boundary) {
  std::vector<Ratio> terms;
  for (const BoundarySegment& s : boundary) {
    const Dyadic& e_w = s.line->exact()[2];
    if (e_w.is_zero()) continue;
    Dyadic numerator = e_w * determinant(*s.line, *s.from, *s.to);
    if (s.reversed) numerator = -numerator;
    terms.emplace_back(std::move(numerator),
                       (turn(*s.line, *s.from) * turn(*s.line, *s.to)).scaled(1));
  }
  return terms;
}

Ratio exact_area(const Boundary& boundary) {
  return sum_of(terms_of_area(boundary));
}

EnclosedSum enclosed_area(const Boundary& boundary) {
  EnclosedSum area;
  for (const Ratio& term : terms_of_area(boundary)) area.add(term);
  return area;
}

Certified<double> approximate_area(const Boundary& boundary) {
  if (boundary.empty()) return {0, 0};
  Certified<double> twice{0, 0};
  for (const BoundarySegment& s : boundary) {
    if (s.line->exact()[2].is_zero()) continue;
    Certified<double> term =
        approximate_determinant(*s.line, *s.from, *s.to) /
        (approximate_turn(*s.line, *s.from) * approximate_turn(*s.line, *s.to)) *
        approximate_coefficient(*s.line, 2);
    if (s.reversed) term.value = -term.value;
    twice = twice + term;
  }
  return twice * Certified<double>{0.5, 0};
}

}  // namespace fathom::area
