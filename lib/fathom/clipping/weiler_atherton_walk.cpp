#include "fathom/clipping/weiler_atherton_walk.h"

#include <algorithm>
#include <map>
#include <set>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/numeric/errors.h"

namespace fathom::clipping {
namespace {

/// How far clockwise the direction P → q lies from the direction P → reference, in half turns: 0
/// for less than one, 1 for exactly one, 2 for more.
template <class Number>
int half_turns(const Point2<Number>& P, const Point2<Number>& reference, const Point2<Number>& q) {
  return 1 + sign_of(cross(P, reference, q));
}

/// Whether P → a comes before P → b, clockwise from P → reference.
template <class Number>
bool comes_before(const Point2<Number>& P, const Point2<Number>& reference, const Point2<Number>& a,
                  const Point2<Number>& b) {
  const int turns_a = half_turns(P, reference, a), turns_b = half_turns(P, reference, b);
  return turns_a != turns_b ? turns_a < turns_b : cross(P, a, b) < 0;
}

/// The edges that leave a point and have not been walked, by their numbers.
template <class Number>
class Leaving {
 public:
  [[nodiscard]] bool is_empty() const { return edges_.empty(); }
  void add(const BorderEdge<Number>& edge, std::size_t number) {
    edges_.push_back({&edge, number});
  }
  void remove(const BorderEdge<Number>&, std::size_t number) {
    std::erase_if(edges_, [&](const Leaver& leaver) { return leaver.number == number; });
  }
  /// The first one clockwise from the point → reference.
  [[nodiscard]] std::size_t first_from(const Point2<Number>& reference) const {
    return std::min_element(edges_.begin(), edges_.end(),
                            [&](const Leaver& a, const Leaver& b) {
                              return comes_before(a.edge->from, reference, a.edge->to, b.edge->to);
                            })
        ->number;
  }

 private:
  struct Leaver {
    const BorderEdge<Number>* edge;
    std::size_t number;
  };
  std::vector<Leaver> edges_;
};

/// Over Rational in order, clockwise from the direction +x: many rings can meet in one point. (By
/// rounded numbers there need not be an order.)
template <>
class Leaving<Rational> {
 public:
  [[nodiscard]] bool is_empty() const { return edges_.empty(); }
  void add(const BorderEdge<Rational>& edge, std::size_t number) {
    edges_.insert({&edge.from, &edge.to, number});
  }
  void remove(const BorderEdge<Rational>& edge, std::size_t number) {
    auto [first, last] = edges_.equal_range({&edge.from, &edge.to, number});
    edges_.erase(std::find_if(first, last, [&](const Leaver& l) { return l.number == number; }));
  }
  [[nodiscard]] std::size_t first_from(const Point2<Rational>& reference) const {
    const auto next = edges_.upper_bound({edges_.begin()->from, &reference, 0});
    return (next == edges_.end() ? edges_.begin() : next)->number;
  }

 private:
  struct Leaver {
    const Point2<Rational>*from, *to;
    std::size_t number;

    [[nodiscard]] int half_turn() const {
      return to->y < from->y || (to->y == from->y && to->x > from->x) ? 0 : 1;
    }
    friend bool operator<(const Leaver& a, const Leaver& b) {
      const int half_a = a.half_turn(), half_b = b.half_turn();
      return half_a != half_b ? half_a < half_b : cross(*a.from, *a.to, *b.to) < 0;
    }
  };
  std::multiset<Leaver> edges_;
};

/// The edges that have not been walked, by the point where they begin.
template <class Number>
class OpenEdges {
 public:
  explicit OpenEdges(const std::vector<BorderEdge<Number>>& edges) : edges_(edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) leaving_[edges[i].from].add(edges[i], i);
    walked_.resize(edges.size(), false);
  }

  [[nodiscard]] bool is_walked(std::size_t i) const { return walked_[i]; }

  const BorderEdge<Number>& take(std::size_t i) {
    walked_[i] = true;
    leaving_[edges_[i].from].remove(edges_[i], i);
    return edges_[i];
  }

  /// The edge that continues from the end of `edge`.
  const BorderEdge<Number>& take_next(const BorderEdge<Number>& edge) {
    const Leaving<Number>& choices = leaving_[edge.to];
    if (choices.is_empty())
      throw InputError(
          "rounding to binary64 has broken the walk along the rings; the exact kernel does it");
    return take(choices.first_from(edge.from));
  }

 private:
  const std::vector<BorderEdge<Number>>& edges_;
  std::map<Point2<Number>, Leaving<Number>> leaving_;
  std::vector<bool> walked_;
};

}  // namespace

template <class Number>
std::vector<std::vector<BorderEdge<Number>>> walk(const std::vector<BorderEdge<Number>>& edges) {
  std::vector<std::vector<BorderEdge<Number>>> walks;
  OpenEdges<Number> open(edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (open.is_walked(i)) continue;
    std::vector<BorderEdge<Number>>& closed = walks.emplace_back();
    closed.push_back(open.take(i));
    while (!(closed.back().to == closed.front().from))
      closed.push_back(open.take_next(closed.back()));
  }
  return walks;
}

template <class Number>
Rings<Number> simple_rings(const std::vector<BorderEdge<Number>>& closed_walk) {
  Rings<Number> rings;
  Ring<Number> path;
  std::map<Point2<Number>, std::size_t> place;  // on the path
  for (const BorderEdge<Number>& edge : closed_walk) {
    place.emplace(edge.from, path.size());
    path.push_back(edge.from);
    const auto met = place.find(edge.to);
    if (met == place.end()) continue;
    const auto first = path.begin() + static_cast<std::ptrdiff_t>(met->second);
    rings.emplace_back(first, path.end());
    for (auto p = first; p != path.end(); ++p) place.erase(*p);
    path.erase(first, path.end());
  }
  return rings;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                            \
  template std::vector<std::vector<BorderEdge<Number>>> walk( \
      const std::vector<BorderEdge<Number>>&);                \
  template Rings<Number> simple_rings(const std::vector<BorderEdge<Number>>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
