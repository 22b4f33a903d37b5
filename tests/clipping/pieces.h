#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton.h"

/// Whether an answer is in as few pieces as it can be and in no fewer: each polygon's interior
/// hangs together, and no two rings share more than points.
namespace fathom::clipping::test {

inline bool is_on(const Point2<Rational>& p, const Point2<Rational>& a, const Point2<Rational>& b) {
  return cross(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y) <= 0;
}

/// The corners of the rings that lie on another ring, each with the rings that meet there.
using Touches = std::map<Point2<Rational>, std::set<std::size_t>>;

inline Touches touches_of(const std::vector<const Ring<Rational>*>& rings) {
  Touches touches;
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (const Point2<Rational>& p : *rings[i])
      for (std::size_t j = 0; j < rings.size(); ++j)
        for (std::size_t k = 0; i != j && k < rings[j]->size(); ++k)
          if (is_on(p, (*rings[j])[k], (*rings[j])[(k + 1) % rings[j]->size()]))
            touches[p].insert({i, j});
  return touches;
}

/// Rings and the points in which they touch form a graph. A cycle in it encloses a part of the
/// interior; without one the interior hangs together.
inline bool is_in_one_piece(const Polygon<Rational>& polygon) {
  std::vector<const Ring<Rational>*> rings{&polygon.outline};
  for (const Ring<Rational>& hole : polygon.holes) rings.push_back(&hole);
  std::vector<std::size_t> leader(rings.size());
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (leader[i] != i) i = leader[i];
    return i;
  };
  for (const auto& [point, meeting] : touches_of(rings))
    for (auto ring = std::next(meeting.begin()); ring != meeting.end(); ++ring) {
      if (find(*ring) == find(*meeting.begin())) return false;
      leader[find(*ring)] = find(*meeting.begin());
    }
  return true;
}

/// Two touch points on one edge of a ring, or a corner and a touch point, are joined by an edge of
/// another ring: then the rings run along each other.
inline bool shares_an_edge(const Ring<Rational>& a, const Ring<Rational>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Point2<Rational>&p = a[i], &q = a[(i + 1) % a.size()];
      const Point2<Rational>&r = b[j], &s = b[(j + 1) % b.size()];
      if (cross(p, q, r) != 0 || cross(p, q, s) != 0) continue;
      // On one line, where the order of points is an order along it.
      if (std::max(std::min(p, q), std::min(r, s)) < std::min(std::max(p, q), std::max(r, s)))
        return true;
    }
  return false;
}

inline std::optional<std::string> piece_fault(const std::vector<Polygon<Rational>>& answer) {
  Rings<Rational> rings;
  for (const Polygon<Rational>& polygon : answer) {
    if (!is_in_one_piece(polygon)) return "a polygon whose interior is in pieces";
    rings.push_back(polygon.outline);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (shares_an_edge(rings[i], rings[j])) return "two rings that share an edge";
  return std::nullopt;
}

}  // namespace fathom::clipping::test
