#include "fathom/area/plane/part_lines.h"

#include <algorithm>
#include <cmath>

namespace fathom::area {
namespace {

/// Whether parallel lines are one: l_k·m_w = l_w·m_k for k = u, v.
bool are_same_line(const HalfPlane& a, const HalfPlane& b) {
  for (const std::size_t k : {0, 1}) {
    const auto product = [k](const HalfPlane& l, const HalfPlane& m) {
      return approximate_coefficient(l, k) * approximate_coefficient(m, 2);
    };
    if (certain_sign(product(a, b) - product(b, a)) != Sign::zero) return false;
  }
  const ExactVector3 &l = a.exact(), &m = b.exact();
  return l[0] * m[2] == l[2] * m[0] && l[1] * m[2] == l[2] * m[1];
}

}  // namespace

OrientedLine PartLines::add(ExactVector3 coefficients, std::span<const std::uint32_t> vertices) {
  HalfPlane line(std::move(coefficients));
  std::vector<Sign> turns;
  turns.reserve(lines_.size() + 1);
  for (std::uint32_t other = 0; other < size(); ++other) {
    const HalfPlane& its = *places_[other];
    turns.push_back(sign_of_turn(line, its, counts_));
    if (turns.back() != Sign::zero || !are_same_line(line, its)) continue;
    vertices_[other].insert(vertices_[other].end(), vertices.begin(), vertices.end());
    return {other, !same_side(line, its)};
  }
  turns.push_back(Sign::zero);
  turns_.push_back(std::move(turns));
  places_.push_back(&lines_.emplace_back(std::move(line)));
  vertices_.emplace_back(vertices.begin(), vertices.end());
  return {size() - 1, false};
}

std::optional<std::uint32_t> PartLines::common_vertex(std::uint32_t a, std::uint32_t b) const {
  const auto& its = vertices_[a];
  const auto found = std::ranges::find_first_of(its, vertices_[b]);
  return found == its.end() ? std::nullopt : std::optional(*found);
}

bool PartLines::has(std::uint32_t line, std::uint32_t vertex) const {
  return std::ranges::find(vertices_[line], vertex) != vertices_[line].end();
}

bool PartLines::share_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return std::any_of(vertices_[a].begin(), vertices_[a].end(),
                     [&](std::uint32_t vertex) { return has(b, vertex) && has(c, vertex); });
}

Sign PartLines::determinant(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Certified<double> d = approximate_determinant(*places_[a], *places_[b], *places_[c]);
  if (std::abs(d.value) > d.error) {
    ++counts_.interval;
    return d.value > 0 ? Sign::positive : Sign::negative;
  }
  if (share_vertex(a, b, c)) return Sign::zero;
  return sign_of_determinant(*places_[a], *places_[b], *places_[c], counts_);
}

// As ConvexPolygon::clip().
LinePolygon clipped(const PartLines& lines, LinePolygon polygon, OrientedLine h) {
  const std::size_t n = polygon.size();
  std::vector<Sign> side(n);
  bool some_inside = false, some_outside = false;
  for (std::size_t k = 0; k < n; ++k) {
    side[k] = determinant(lines, h, polygon[k], polygon[(k + 1) % n]);
    some_inside |= side[k] == Sign::positive;
    some_outside |= side[k] == Sign::negative;
  }
  if (!some_inside) return {};
  if (!some_outside) return polygon;
  LinePolygon kept;
  kept.reserve(n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const bool starts_inside = side[(k + n - 1) % n] == Sign::positive;
    const bool ends_inside = side[k] == Sign::positive;
    if (starts_inside || ends_inside) kept.push_back(polygon[k]);
    if (starts_inside && !ends_inside) kept.push_back(h);
  }
  return kept;
}

namespace {

/// The foot of the origin on a line.
class Foot {
 public:
  // The coefficients err by 2u of themselves (convex_polygon.h), squares by 5u, their sum by 6u,
  // the quotient by 2u + 6u + u with terms of second order below u, its products with a
  // coefficient by 10u + 2u + u.
  explicit Foot(const HalfPlane& e) {
    const auto& [eu, ev, ew] = e.approximate();
    const double squares = eu * eu + ev * ev;
    is_known_ = squares > 0x1p-400;
    const double scale = -ew / squares;
    u_ = eu * scale;
    v_ = ev * scale;
  }

  /// The value of m there. It errs by at most 24u of the sum of the products' absolute values:
  /// 14u + 2u + u of each product, and 2u for two sums, with terms of second order.
  [[nodiscard]] Certified<double> value(const HalfPlane& m) const {
    if (!is_known_) return {};
    const auto& [mu, mv, mw] = m.approximate();
    const double p = mu * u_, q = mv * v_;
    constexpr double bound = 24 * unit_roundoff<double>;
    return {p + q + mw, bound * (std::abs(p) + std::abs(q) + std::abs(mw)) + most_underflow};
  }

 private:
  double u_ = 0, v_ = 0;
  bool is_known_ = false;
};

}  // namespace

// The walk goes from the foot in the direction (e_v, −e_u). There the line m has the value
// m(foot) − τ·turn(e, m), so it crosses at τ = m(foot) / turn(e, m).
LineOrder::Place LineOrder::place_of(const Certified<double>& value, const Certified<double>& turn,
                                     std::uint32_t line) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double size = std::abs(turn.value);
  // |x/y − X/Y| ≤ (E_x + |x/y|·E_y) / (|y| − E_y)
  if (!(size > 2 * turn.error)) return {-infinity, infinity, line};
  const double tau = value.value / turn.value;
  const double error = ((value.error + std::abs(tau) * turn.error) / (size - turn.error) +
                        2 * unit_roundoff<double> * std::abs(tau)) *
                           (1 + 0x1p-40) +
                       most_underflow;
  if (!(error < infinity)) return {-infinity, infinity, line};
  return {tau - error, tau + error, line};
}

LineOrder::Ends LineOrder::ends_in(const PartLines& lines, std::uint32_t along,
                                   const LinePolygon& within, const std::vector<Place>& places) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Ends ends{-infinity, infinity};
  for (const OrientedLine& h : within) {
    const auto place = std::ranges::find(places, h.line, &Place::line);
    if (place == places.end()) continue;
    if (oriented(lines.turn(along, h.line), h.reversed) == Sign::negative) {
      ends.least_low = std::max(ends.least_low, place->low);
    } else {
      ends.greatest_high = std::min(ends.greatest_high, place->high);
    }
  }
  return ends;
}

void LineOrder::find(const PartLines& lines, std::uint32_t along, const LinePolygon& within) {
  ranks_.assign(lines.size(), 0);
  first_of_rank_.clear();
  places_.clear();
  const HalfPlane& e = lines[along];
  const Foot foot(e);
  for (std::uint32_t line = 0; line < lines.size(); ++line) {
    if (lines.turn(along, line) == Sign::zero) continue;
    const HalfPlane& m = lines[line];
    places_.push_back(place_of(foot.value(m), approximate_turn(e, m), line));
  }
  const Ends ends = ends_in(lines, along, within, places_);
  before_.clear();
  after_.clear();
  for (const Place& each : places_) {
    if (each.high < ends.least_low) before_.push_back(each.line);
    if (each.low > ends.greatest_high) after_.push_back(each.line);
  }
  std::erase_if(places_, [&](const Place& each) {
    return each.high < ends.least_low || each.low > ends.greatest_high;
  });
  // As compare_crossings().
  const auto compare = [&](const Place& a, const Place& b) {
    if (a.high < b.low) return Sign::negative;
    if (b.high < a.low) return Sign::positive;
    if (a.line == b.line) return Sign::zero;
    return -lines.determinant(along, a.line, b.line) * lines.turn(along, a.line) *
           lines.turn(along, b.line);
  };
  std::sort(places_.begin(), places_.end(),
            [&](const Place& a, const Place& b) { return compare(a, b) == Sign::negative; });
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const bool is_new = k == 0 || compare(places_[k - 1], places_[k]) != Sign::zero;
    if (is_new) first_of_rank_.push_back(places_[k].line);
    ranks_[places_[k].line] = end() - 1;
  }
  for (const std::uint32_t line : before_) ranks_[line] = 0;
  for (const std::uint32_t line : after_) ranks_[line] = end() - 1;
}

}  // namespace fathom::area
