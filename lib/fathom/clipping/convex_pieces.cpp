#include "fathom/clipping/convex_pieces.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
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

  /// Whether corner i of what remains turns left and no other corner lies in the closed triangle;
  /// remembers one that does.
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

  /// Between which neighbours a corner was found to be no ear, and the corner in its triangle; none
  /// where it does not turn left.
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
