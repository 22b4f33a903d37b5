#include "fathom/clipping/weiler_atherton_walk.h"

#include <algorithm>
#include <map>

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

/// The edges that have not been walked, by the point where they begin.
template <class Number>
class OpenEdges {
 public:
  explicit OpenEdges(const std::vector<BorderEdge<Number>>& edges) : edges_(edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) leaving_[edges[i].from].push_back(i);
    walked_.resize(edges.size(), false);
  }

  [[nodiscard]] bool is_walked(std::size_t i) const { return walked_[i]; }

  const BorderEdge<Number>& take(std::size_t i) {
    walked_[i] = true;
    std::erase(leaving_[edges_[i].from], i);
    return edges_[i];
  }

  /// The edge that continues from the end of `edge`.
  const BorderEdge<Number>& take_next(const BorderEdge<Number>& edge) {
    const std::vector<std::size_t>& choices = leaving_[edge.to];
    if (choices.empty())
      throw InputError(
          "rounding to binary64 has broken the walk along the rings; the exact kernel does it");
    return take(*std::min_element(choices.begin(), choices.end(), [&](auto a, auto b) {
      return comes_before(edge.to, edge.from, edges_[a].to, edges_[b].to);
    }));
  }

 private:
  const std::vector<BorderEdge<Number>>& edges_;
  std::map<Point2<Number>, std::vector<std::size_t>> leaving_;
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
