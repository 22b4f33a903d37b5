#include "fathom/area/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fathom/numeric/certified.h"

namespace fathom::area {
namespace {

constexpr double u = unit_roundoff<double>;

/// The least e such that all components are below 2^e; 0 if they are 0.
long greatest_exponent(const ExactVector3& l) {
  std::optional<long> top;
  for (const Dyadic& x : l) {
    if (!x.is_zero()) top = std::max(top.value_or(x.top()), x.top());
  }
  return top.value_or(0);
}

/// Whether the lines have the same coefficients up to a sign. (Lines with other coefficients may be
/// the same line, too; this is the common case, an edge that two triangles share.)
bool same_coefficients(const HalfPlane& a, const HalfPlane& b) {
  if (&a == &b) return true;
  const auto& x = a.exact();
  const auto& y = b.exact();
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(std::abs(a.approximate()[k]) - std::abs(b.approximate()[k])) >
        0x1p-51 * std::abs(a.approximate()[k])) {
      return false;
    }
  }
  const bool turned = x[0].sign() != y[0].sign() || x[1].sign() != y[1].sign();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(turned ? x[k] == -y[k] : x[k] == y[k])) return false;
  }
  return true;
}

}  // namespace

HalfPlane::HalfPlane(ExactVector3 l) : exact_(std::move(l)), exponent_(greatest_exponent(exact_)) {
  for (std::size_t k = 0; k < 3; ++k) {
    exact_[k] = exact_[k].scaled(-exponent_);
    approximate_[k] = enclose(exact_[k]).lower;
  }
}

Certified<double> approximate_coefficient(const HalfPlane& l, std::size_t k) {
  return {l.approximate()[k],
          (2 * u * std::abs(l.approximate()[k]) + most_underflow) * bound_rounding};
}

// Coefficients are read with a relative error of at most 2u. Then a product of two has been
// multiplied by at most five factors 1 ± u, the difference by one more; a product of three by at
// most 6 + 2, two sums and the inner difference by three more. Hence the errors 6u and 11u times
// the sum of the products' absolute values, which is itself computed with a relative error below
// 10u: 8 and 16 are enough.
Certified<double> approximate_turn(const HalfPlane& a, const HalfPlane& b) {
  const auto& x = a.approximate();
  const auto& y = b.approximate();
  const double p = x[0] * y[1], q = x[1] * y[0];
  return {p - q, 8 * u * (std::abs(p) + std::abs(q)) + most_underflow};
}

Certified<double> approximate_determinant(const HalfPlane& a, const HalfPlane& b,
                                          const HalfPlane& c) {
  const auto& x = a.approximate();
  const auto& y = b.approximate();
  const auto& z = c.approximate();
  double value = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double p = y[i] * z[j], q = y[j] * z[i];
    value += x[k] * (p - q);
    size += std::abs(x[k]) * (std::abs(p) + std::abs(q));
  }
  return {value, 16 * u * size + most_underflow};
}

Dyadic turn(const HalfPlane& a, const HalfPlane& b) {
  return a.exact()[0] * b.exact()[1] - a.exact()[1] * b.exact()[0];
}

Dyadic determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c) {
  return determinant(a.exact(), b.exact(), c.exact());
}

Sign sign_of_turn(const HalfPlane& a, const HalfPlane& b, TierCounts& counts) {
  const Certified<double> t = approximate_turn(a, b);
  if (std::abs(t.value) > t.error) {
    ++counts.interval;
    return t.value > 0 ? Sign::positive : Sign::negative;
  }
  ++counts.exact;
  if (same_coefficients(a, b)) return Sign::zero;
  return turn(a, b).sign();
}

Sign sign_of_determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c,
                         TierCounts& counts) {
  const Certified<double> d = approximate_determinant(a, b, c);
  if (std::abs(d.value) > d.error) {
    ++counts.interval;
    return d.value > 0 ? Sign::positive : Sign::negative;
  }
  ++counts.exact;
  if (same_coefficients(a, b) || same_coefficients(b, c) || same_coefficients(a, c)) {
    return Sign::zero;
  }
  return determinant(a, b, c).sign();
}

bool same_side(const HalfPlane& a, const HalfPlane& b) {
  // Parallel normals: a component that is not zero in one is not zero in the other.
  const std::size_t k = a.exact()[0].is_zero() ? 1 : 0;
  return a.exact()[k].sign() == b.exact()[k].sign();
}

// The place where e and m cross is the point e × m, homogeneous with the weight turn(e, m). There n
// has the value n·(e × m) / turn(e, m) = det(e, m, n) / turn(e, m). The walk along e goes in the
// direction (e_v, −e_u), in which n grows at the rate −turn(e, n). Hence
// τ(n) − τ(m) = det(e, m, n) / (turn(e, m)·turn(e, n)).
Sign compare_crossings(const HalfPlane& e, const HalfPlane& m, const HalfPlane& n,
                       TierCounts& counts) {
  return -sign_of_determinant(e, m, n, counts) * sign_of_turn(e, m, counts) *
         sign_of_turn(e, n, counts);
}

Sign side_of_crossing(const HalfPlane& m, const HalfPlane& e, const HalfPlane& at,
                      TierCounts& counts) {
  return sign_of_determinant(e, at, m, counts) * sign_of_turn(e, at, counts);
}

namespace {

/// x_i·y_j − x_j·y_i
Certified<double> minor(const HalfPlane& x, const HalfPlane& y, std::size_t i, std::size_t j) {
  Certified<double> q = approximate_coefficient(x, j) * approximate_coefficient(y, i);
  q.value = -q.value;
  return approximate_coefficient(x, i) * approximate_coefficient(y, j) + q;
}

void widen(Interval& range, const Certified<double>& x) {
  const Interval around = enclose(x);
  range.lower = std::min(range.lower, around.lower);
  range.upper = std::max(range.upper, around.upper);
}

}  // namespace

CertifiedPoint approximate_crossing(const HalfPlane& a, const HalfPlane& b) {
  const Certified<double> weight = approximate_turn(a, b);
  return {minor(a, b, 1, 2) / weight, minor(a, b, 2, 0) / weight};
}

void ConvexPolygon::find_bounds() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bounds_.u = bounds_.v = {infinity, -infinity};
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const CertifiedPoint vertex = approximate_crossing(*edges_[k], after(k));
    widen(bounds_.u, vertex.u);
    widen(bounds_.v, vertex.v);
  }
}

// Vertex k lies between the edges k and k + 1, whose turn is positive: there h has the sign of
// det(h, edge k, edge k + 1). An edge remains if one of its ends is inside; h becomes the next edge
// after the edge that leaves h.
bool ConvexPolygon::clip(const HalfPlane& h, TierCounts& counts) {
  const std::size_t n = edges_.size();
  std::vector<Sign> side(n);
  for (std::size_t k = 0; k < n; ++k)
    side[k] = sign_of_determinant(h, *edges_[k], after(k), counts);
  if (std::find(side.begin(), side.end(), Sign::positive) == side.end()) return false;
  if (std::find(side.begin(), side.end(), Sign::negative) == side.end()) return true;
  std::vector<const HalfPlane*> kept;
  kept.reserve(n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const bool starts_inside = side[(k + n - 1) % n] == Sign::positive;
    const bool ends_inside = side[k] == Sign::positive;
    if (starts_inside || ends_inside) kept.push_back(edges_[k]);
    if (starts_inside && !ends_inside) kept.push_back(&h);
  }
  edges_ = std::move(kept);
  find_bounds();
  return true;
}

namespace {

std::size_t hash_of(const HalfPlane& h) {
  std::size_t hash = 0;
  for (const Dyadic& x : h.exact()) hash = hash * 31 + fathom::hash_of(x);
  return hash;
}

}  // namespace

const HalfPlane& MergedLines::find(const ExactVector3& coefficients) {
  HalfPlane line(without_common_factor(coefficients));
  const std::size_t hash = hash_of(line);
  const auto [first, end] = by_hash_.equal_range(hash);
  for (auto candidate = first; candidate != end; ++candidate) {
    if (candidate->second->exact() == line.exact()) return *candidate->second;
  }
  const HalfPlane& kept = lines_.emplace_back(std::move(line));
  by_hash_.emplace(hash, &kept);
  known_.emplace(&kept, &kept);
  return kept;
}

const HalfPlane& MergedLines::of(const HalfPlane& h) {
  if (const auto known = known_.find(&h); known != known_.end()) return *known->second;
  const HalfPlane& line = find(h.exact());
  known_.emplace(&h, &line);
  return line;
}

const HalfPlane& MergedLines::opposite(const HalfPlane& h) {
  const HalfPlane& line = of(h);
  if (const auto known = opposites_.find(&line); known != opposites_.end()) return *known->second;
  const ExactVector3& l = line.exact();
  const HalfPlane& other = find({-l[0], -l[1], -l[2]});
  opposites_.emplace(&line, &other);
  opposites_.emplace(&other, &line);
  return other;
}

ConvexPolygon MergedLines::of(const ConvexPolygon& polygon) {
  std::vector<const HalfPlane*> edges;
  edges.reserve(polygon.edges().size());
  for (const HalfPlane* edge : polygon.edges()) edges.push_back(&of(*edge));
  return ConvexPolygon(std::move(edges));
}

}  // namespace fathom::area
