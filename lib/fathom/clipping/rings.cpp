#include "fathom/clipping/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/nesting.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/interruption.h"

namespace fathom::clipping {
namespace {

[[noreturn]] void refuse(const std::string& side, std::size_t ring, const std::string& reason) {
  throw InputError(side + " ring " + std::to_string(ring) + " " + reason);
}

bool is_finite(double x) {
  return std::isfinite(x);
}
bool is_finite(const Rational&) {
  return true;
}

template <class Number>
void check_finite(const Ring<Number>& ring, const std::string& side, std::size_t number) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!is_finite(ring[i].x) || !is_finite(ring[i].y))
      refuse(side, number, "has a coordinate that is not finite, at corner " + std::to_string(i));
}

template <class Number>
Ring<Number> without_repetitions(Ring<Number> ring) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

void check_corners(const Ring<Rational>& ring, const std::string& side, std::size_t number) {
  Ring<Rational> corners = ring;
  OccasionalInterruption check;
  std::sort(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
    check();
    return a < b;
  });
  const auto distinct = std::unique(corners.begin(), corners.end()) - corners.begin();
  if (distinct < 3)
    refuse(side, number,
           "has " + std::to_string(distinct) +
               (distinct == 1 ? " distinct corner" : " distinct corners") +
               "; expected at least 3");
  for (const Point2<Rational>& p : ring)
    if (cross(ring[0], ring[1], p) != 0) return;
  refuse(side, number, "has no area: its corners lie on one line");
}

void check_simple(const Ring<Rational>& ring, const std::string& side, std::size_t number) {
  if (const auto meeting = self_contact(ring))
    refuse(side, number,
           "is not simple: its edges " + std::to_string(meeting->first_edge) + " and " +
               std::to_string(meeting->second_edge) + " meet at " + to_text(meeting->point));
}

}  // namespace

template <class Number>
Number sum_of(std::vector<Number> terms) {
  const StandardArithmetic standard;
  if constexpr (std::is_same_v<Number, Rational>) {
    for (; terms.size() > 1; terms.resize((terms.size() + 1) / 2))
      for (std::size_t i = 0; 2 * i < terms.size(); ++i)
        terms[i] =
            2 * i + 1 < terms.size() ? Rational(terms[2 * i] + terms[2 * i + 1]) : terms[2 * i];
    return terms.empty() ? Rational(0) : terms[0];
  } else {
    return std::accumulate(terms.begin(), terms.end(), Number(0));
  }
}

template <class Number>
Number signed_area(const Ring<Number>& ring) {
  const StandardArithmetic standard;
  check_interruption();
  std::vector<Number> terms;
  for (std::size_t i = 2; i < ring.size(); ++i)
    terms.push_back(cross(ring[0], ring[i - 1], ring[i]));
  return sum_of(std::move(terms)) / 2;
}

template <class Number>
Number signed_area(const Rings<Number>& rings) {
  const StandardArithmetic standard;
  std::vector<Number> areas;
  for (const Ring<Number>& ring : rings) areas.push_back(signed_area(ring));
  return sum_of(std::move(areas));
}

template <class Number>
Rings<Number> checked_rings(const Rings<Number>& rings, const std::string& side) {
  const StandardArithmetic standard;
  Rings<Number> checked;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    check_finite(rings[i], side, i);
    checked.push_back(without_repetitions(rings[i]));
  }
  const Rings<Rational> exact = to_exact(checked);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    check_corners(exact[i], side, i);
    check_simple(exact[i], side, i);
  }
  const std::vector<int> depths = nesting_depths(exact, side);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const bool is_hole = depths[i] % 2 != 0;
    if ((signed_area(exact[i]) < 0) != is_hole) std::reverse(checked[i].begin(), checked[i].end());
  }
  return checked;
}

template <class Number>
void check_convex(const Ring<Number>& ring, const std::string& side) {
  const StandardArithmetic standard;
  const Ring<Rational> exact = to_exact(Rings<Number>{ring})[0];
  const std::size_t n = exact.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(exact[i], exact[(i + 1) % n], exact[(i + 2) % n]) < 0)
      throw InputError(side + " is not convex at " + to_text(exact[(i + 1) % n]) +
                       "; expected a convex polygon (weiler-atherton takes any)");
}

template <class Number>
Ring<Number> canonical(const Ring<Number>& ring) {
  Ring<Number> corners;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]) != 0) corners.push_back(ring[i]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                \
  template Number sum_of(std::vector<Number>);                                    \
  template Number signed_area(const Ring<Number>&);                               \
  template Number signed_area(const Rings<Number>&);                              \
  template Rings<Number> checked_rings(const Rings<Number>&, const std::string&); \
  template void check_convex(const Ring<Number>&, const std::string&);            \
  template Ring<Number> canonical(const Ring<Number>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

namespace {

/// Corners of the ring by their numbers, counter-clockwise.
using Piece = std::vector<std::size_t>;

class Decomposition {
 public:
  explicit Decomposition(const Ring<Rational>& ring) : ring_(ring) {
    boxes_.reserve(ring.size());
    for (const Point2<Rational>& p : ring) boxes_.push_back(box_of(p));
  }

  std::vector<Piece> run() {
    cut_ears();
    drop_diagonals();
    return pieces_;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  int turn(std::size_t a, std::size_t b, std::size_t c) const {
    const auto settled = settled_sign_of_cross(boxes_[a], boxes_[b], boxes_[c]);
    return settled ? *settled : sign_of(cross(ring_[a], ring_[b], ring_[c]));
  }

  /// Whether corner i of the rest turns left and no other corner lies in the closed triangle;
  /// remembers such a corner, if there is one.
  bool is_ear(const Piece& rest, std::size_t i) {
    const std::size_t n = rest.size();
    const std::size_t a = rest[(i + n - 1) % n], b = rest[i], c = rest[(i + 1) % n];
    const Blocked& known = blocked_[b];
    if (known.before == a && known.behind == c && (known.by == none || !is_cut_[known.by]))
      return false;
    if (turn(a, b, c) <= 0) {
      blocked_[b] = {a, c, none};
      return false;
    }
    const auto obstacle = std::find_if(rest.begin(), rest.end(), [&](std::size_t p) {
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
    if (obstacle == rest.end()) return true;
    blocked_[b] = {a, c, *obstacle};
    return false;
  }

  void cut_ears() {
    Piece rest(ring_.size());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
    blocked_.assign(rest.size(), {none, none, none});
    is_cut_.assign(rest.size(), false);
    while (rest.size() > 3) {
      std::size_t i = 0;
      while (i < rest.size() && !is_ear(rest, i)) ++i;
      if (i == rest.size())
        throw std::invalid_argument("a simple counter-clockwise ring has an ear");
      const std::size_t n = rest.size();
      const std::size_t a = rest[(i + n - 1) % n], c = rest[(i + 1) % n];
      pieces_.push_back({a, rest[i], c});
      diagonals_.emplace_back(a, c);
      is_cut_[rest[i]] = true;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    }
    pieces_.push_back(rest);
  }

  /// The piece with the edge from → to, turned so that it begins with `to` and ends with `from`.
  std::size_t piece_with(std::size_t from, std::size_t to) {
    for (std::size_t k = 0;; ++k) {
      Piece& piece = pieces_[k];
      const auto place = std::find(piece.begin(), piece.end(), to);
      if (place == piece.end()) continue;
      const auto before = place == piece.begin() ? piece.end() - 1 : place - 1;
      if (*before != from) continue;
      std::rotate(piece.begin(), place, piece.end());
      return k;
    }
  }

  void drop_diagonals() {
    for (const auto& [a, c] : diagonals_) {
      const std::size_t p = piece_with(c, a), q = piece_with(a, c);
      const Piece &P = pieces_[p], &Q = pieces_[q];  // a … c and c … a
      const bool convex_at_a = turn(Q[Q.size() - 2], a, P[1]) >= 0;
      const bool convex_at_c = turn(P[P.size() - 2], c, Q[1]) >= 0;
      if (!convex_at_a || !convex_at_c) continue;
      Piece both = P;
      both.insert(both.end(), Q.begin() + 1, Q.end() - 1);
      pieces_[p] = std::move(both);
      pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(q));
    }
  }

  /// The neighbours between which a corner was found not to be an ear, and the corner in its
  /// triangle; none if it does not turn left.
  struct Blocked {
    std::size_t before, behind, by;
  };

  const Ring<Rational>& ring_;
  std::vector<Box> boxes_;
  std::vector<Blocked> blocked_;
  std::vector<bool> is_cut_;
  std::vector<Piece> pieces_;
  std::vector<std::pair<std::size_t, std::size_t>> diagonals_;
};

}  // namespace

template <class Number>
Rings<Number> convex_pieces(const Ring<Number>& ring) {
  const StandardArithmetic standard;
  const Ring<Rational> exact = to_exact(Rings<Number>{ring})[0];
  Rings<Number> result;
  for (const Piece& piece : Decomposition(exact).run()) {
    result.emplace_back();
    for (const std::size_t corner : piece) result.back().push_back(ring[corner]);
  }
  return result;
}

template Rings<double> convex_pieces(const Ring<double>&);
template Rings<Rational> convex_pieces(const Ring<Rational>&);

}  // namespace fathom::clipping
