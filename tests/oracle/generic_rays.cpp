#include "tests/oracle/generic_rays.h"

#include <algorithm>

namespace fathom::oracle {
namespace {

/// c₀ + c₁ε + c₂ε² + c₃ε³ for an infinitely small ε > 0.
using Moved = std::array<Q, 4>;

int sign(const Moved& x) {
  for (const Q& coefficient : x)
    if (sgn(coefficient) != 0) return sgn(coefficient);
  return 0;
}

Q determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Vector less(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The system t·d − β(B − A) − γ(C − A) = A − o, of which o moves by (ε, ε², ε³).
class System {
 public:
  System(const GivenRay& line, const Triangle& triangle)
      : line_(line),
        corner_(triangle[0]),
        minus_p_(less(triangle[0], triangle[1])),
        minus_r_(less(triangle[0], triangle[2])),
        determinant_(determinant(line.direction, minus_p_, minus_r_)) {}

  [[nodiscard]] const Q& divisor() const { return determinant_; }
  /// Numerators by Cramer's rule.
  [[nodiscard]] Moved t() const {
    return moved([&](const Vector& right) { return determinant(right, minus_p_, minus_r_); });
  }
  [[nodiscard]] Moved beta() const {
    return moved(
        [&](const Vector& right) { return determinant(line_.direction, right, minus_r_); });
  }
  [[nodiscard]] Moved gamma() const {
    return moved(
        [&](const Vector& right) { return determinant(line_.direction, minus_p_, right); });
  }

 private:
  /// A numerator is linear in the right side.
  template <class Numerator>
  [[nodiscard]] Moved moved(const Numerator& numerator) const {
    Moved result;
    result[0] = numerator(less(corner_, line_.origin));
    for (std::size_t k = 0; k < 3; ++k) {
      Vector step{0, 0, 0};
      step[k] = -1;
      result[k + 1] = numerator(step);
    }
    return result;
  }

  const GivenRay& line_;
  Vector corner_, minus_p_, minus_r_;
  Q determinant_;
};

/// The hit of the whole line.
std::optional<RayHit> meet(const GivenRay& line, const Triangle& triangle, std::uint32_t number) {
  const System system(line, triangle);
  const int turn = sgn(system.divisor());
  if (turn == 0) return std::nullopt;
  const Moved beta = system.beta(), gamma = system.gamma();
  Moved alpha;
  for (std::size_t k = 0; k < 4; ++k)
    alpha[k] = (k == 0 ? system.divisor() : Q(0)) - beta[k] - gamma[k];
  if (sign(alpha) != turn || sign(beta) != turn || sign(gamma) != turn) return std::nullopt;
  RayHit hit{.triangle = number};
  hit.t = system.t()[0] / system.divisor();
  hit.weight_b = beta[0] / system.divisor();
  hit.weight_c = gamma[0] / system.divisor();
  hit.moved_side = sign(system.t()) * turn;
  const Vector p = less(triangle[1], triangle[0]), r = less(triangle[2], triangle[0]);
  hit.normal = {p[1] * r[2] - p[2] * r[1], p[2] * r[0] - p[0] * r[2], p[0] * r[1] - p[1] * r[0]};
  hit.side = sgn(Q(hit.normal[0] * line.direction[0] + hit.normal[1] * line.direction[1] +
                   hit.normal[2] * line.direction[2]));
  for (std::size_t k = 0; k < 3; ++k) {
    if (hit.side > 0) hit.normal[k] = -hit.normal[k];
    hit.point[k] = line.origin[k] + hit.t * line.direction[k];
  }
  return hit;
}

bool counts(const RayHit& hit, const Stretch& stretch) {
  if (stretch.left_out != 0 && hit.side == stretch.left_out) return false;
  if (stretch.first && (stretch.open ? hit.t <= *stretch.first : hit.t < *stretch.first))
    return false;
  return !stretch.last || (stretch.open ? hit.t < *stretch.last : hit.t <= *stretch.last);
}

}  // namespace

std::vector<RayHit> hits_of(const GivenRay& line, const std::vector<Triangle>& triangles,
                            const Stretch& stretch) {
  std::vector<RayHit> hits;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const std::optional<RayHit> hit = meet(line, triangles[i], i);
    if (hit && counts(*hit, stretch)) hits.push_back(*hit);
  }
  std::ranges::stable_sort(hits, [](const RayHit& a, const RayHit& b) { return a.t < b.t; });
  return hits;
}

int winding_number(const Vector& point, const Vector& direction,
                   const std::vector<Triangle>& triangles) {
  int number = 0;
  for (const RayHit& hit : hits_of({point, direction}, triangles, {.first = std::nullopt}))
    if (hit.moved_side > 0) number += hit.side;
  return number;
}

Vector exact_vector(const std::array<double, 3>& v) {
  return {Q(v[0]), Q(v[1]), Q(v[2])};
}

}  // namespace fathom::oracle
