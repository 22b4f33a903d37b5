#include "tests/oracle/ray_caster.h"

namespace fathom::oracle {

Q power_of_two_below(int bits) {
  Q power = 1;
  mpq_div_2exp(power.get_mpq_t(), power.get_mpq_t(), static_cast<mp_bitcnt_t>(bits));
  return power;
}

namespace {

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Q dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The determinant of three columns, by expansion along the first.
Q det(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Cramer's rule for o + t·d = A + β(B − A) + γ(C − A): numerators of t, β, γ, and the determinant.
struct Cramer {
  Q t, beta, gamma, determinant;
};

Cramer solve(const Vector& o, const Vector& d, const Triangle& triangle) {
  const auto& [A, B, C] = triangle;
  const Vector minus_e1 = minus(A, B), minus_e2 = minus(A, C), right = minus(A, o);
  return {det(right, minus_e1, minus_e2), det(d, right, minus_e2), det(d, minus_e1, right),
          det(d, minus_e1, minus_e2)};
}

/// The normal of a triangle that is turned against a direction.
Vector normal_against(const Vector& direction, const Triangle& triangle) {
  const auto& [A, B, C] = triangle;
  const Vector e1 = minus(B, A), e2 = minus(C, A);
  const Vector n = {e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2],
                    e1[0] * e2[1] - e1[1] * e2[0]};
  if (sgn(dot(n, direction)) > 0) return {-n[0], -n[1], -n[2]};
  return n;
}

/// The sign of a value whose rational part is `at`, moved by an infinitesimal step to the right
/// and a smaller one down; the value is affine in (u, v).
int sign_after_step(const Q& at, const Q& one_right, const Q& one_down) {
  if (sgn(at) != 0) return sgn(at);
  if (sgn(one_right) != 0) return sgn(one_right);
  return sgn(one_down);
}

}  // namespace

RayCaster::RayCaster(const RayCamera& camera, const std::vector<Triangle>& triangles)
    : camera_(camera), world_(triangles) {
  for (const Triangle& t : triangles) {
    in_camera_.push_back({to_camera(t[0]), to_camera(t[1]), to_camera(t[2])});
  }
}

Vector RayCaster::to_camera(const Vector& w) const {
  Vector p;
  for (int i = 0; i < 3; ++i) {
    const auto& row = camera_.world_to_camera[i];
    p[i] = row[0] * w[0] + row[1] * w[1] + row[2] * w[2] + row[3];
  }
  return p;
}

Vector RayCaster::to_world(const Vector& p) const {
  std::array<Vector, 3> column;
  Vector right;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) column[k][i] = camera_.world_to_camera[i][k];
    right[i] = p[i] - camera_.world_to_camera[i][3];
  }
  const Q d = det(column[0], column[1], column[2]);
  return {det(right, column[1], column[2]) / d, det(column[0], right, column[2]) / d,
          det(column[0], column[1], right) / d};
}

// The point of the plane z = 1 (perspective) or z = 0 (orthographic) that is seen at (u, v), where
// (cx, cy) give the top left pixel's centre the coordinate pixel_centre.
void RayCaster::ray(const Q& u, const Q& v, Vector& origin, Vector& direction) const {
  const Q shift = camera_.pixel_centre - Q(1, 2);
  const Q y = (v + shift - camera_.cy) / camera_.fy;
  const Q x = (u + shift - camera_.cx - camera_.skew * y) / camera_.fx;
  if (camera_.perspective) {
    origin = {0, 0, 0};
    direction = {x, y, 1};
  } else {
    origin = {x, y, 0};
    direction = {0, 0, 1};
  }
}

std::optional<RayCaster::Meeting> RayCaster::meet(const Triangle& triangle, int x, int y) const {
  const Q u = x + Q(1, 2), v = y + Q(1, 2);
  const auto solve_at = [&](const Q& at_u, const Q& at_v) {
    Vector o, d;
    ray(at_u, at_v, o, d);
    return solve(o, d, triangle);
  };
  const Cramer here = solve_at(u, v), right = solve_at(u + 1, v), down = solve_at(u, v + 1);
  if (sgn(here.determinant) == 0) return std::nullopt;
  const int side = sgn(here.determinant);
  const auto inside = [&](const auto& weight) {
    return side * sign_after_step(weight(here), weight(right) - weight(here),
                                  weight(down) - weight(here)) >
           0;
  };
  if (!inside([](const Cramer& c) -> Q { return c.beta; })) return std::nullopt;
  if (!inside([](const Cramer& c) -> Q { return c.gamma; })) return std::nullopt;
  if (!inside([](const Cramer& c) -> Q { return c.determinant - c.beta - c.gamma; })) {
    return std::nullopt;
  }
  Meeting m{here.t / here.determinant, here.beta / here.determinant, here.gamma / here.determinant};
  if (m.depth <= 0 || m.depth < camera_.near) return std::nullopt;
  if (camera_.far && m.depth > *camera_.far) return std::nullopt;
  return m;
}

namespace {

int sign_at_bent_ray(const Q& value) {
  static const Q least = power_of_two_below(zero_bits);
  return abs(value) < least ? 0 : sgn(value);
}

}  // namespace

// The direction takes an infinitesimal step to the right in the image, a smaller one downwards, and
// one smaller still forwards: all weights are linear in it.
std::optional<RayCaster::Meeting> RayCaster::meet_bent(const Triangle& triangle,
                                                       const Vector& d) const {
  const Vector eye = {0, 0, 0};
  const Cramer here = solve(eye, d, triangle);
  const int side = sign_at_bent_ray(here.determinant);
  if (side == 0 || sgn(here.t) == 0) return std::nullopt;
  const std::array<Vector, 3> steps{
      {{Q(sgn(camera_.fx)), 0, 0}, {0, Q(sgn(camera_.fy)), 0}, {0, 0, 1}}};
  const auto inside = [&](const auto& weight) {
    int sign = sign_at_bent_ray(weight(here));
    for (int k = 0; k < 3 && sign == 0; ++k) sign = sgn(weight(solve(eye, steps[k], triangle)));
    return side * sign > 0;
  };
  if (!inside([](const Cramer& c) -> Q { return c.beta; })) return std::nullopt;
  if (!inside([](const Cramer& c) -> Q { return c.gamma; })) return std::nullopt;
  if (!inside([](const Cramer& c) -> Q { return c.determinant - c.beta - c.gamma; }))
    return std::nullopt;
  Meeting m{here.t / here.determinant, here.beta / here.determinant, here.gamma / here.determinant};
  if (sgn(m.depth) <= 0) return std::nullopt;
  // −1 before a limit, 1 beyond it.
  const auto beside = [&](const Q& limit) {
    if (!camera_.by_distance) return sign_at_bent_ray(m.depth * d[2] - limit);
    return sign_at_bent_ray(m.depth * m.depth * dot(d, d) - limit * limit);
  };
  if (beside(camera_.near) < 0) return std::nullopt;
  if (camera_.far && beside(*camera_.far) > 0) return std::nullopt;
  return m;
}

std::optional<Hit> RayCaster::cast_bent(const Vector& d) const {
  std::optional<Hit> nearest;
  Q t;
  for (std::uint32_t i = 0; i < in_camera_.size(); ++i) {
    const auto m = meet_bent(in_camera_[i], d);
    if (!m || (nearest && sign_at_bent_ray(m->depth - t) >= 0)) continue;
    nearest = Hit{.triangle = i, .weight_b = m->weight_b, .weight_c = m->weight_c};
    t = m->depth;
  }
  if (!nearest) return nearest;
  const auto settled = [](const Q& q) { return sign_at_bent_ray(q) == 0 ? Q(0) : q; };
  const Vector p = {settled(t * d[0]), settled(t * d[1]), settled(t * d[2])};
  nearest->depth = p[2];
  nearest->squared_distance = dot(p, p);
  nearest->position = to_world(p);
  for (Q& coordinate : nearest->position) coordinate = settled(coordinate);
  nearest->weight_b = settled(nearest->weight_b);
  nearest->weight_c = settled(nearest->weight_c);
  const Vector along = minus(to_world({p[0] + d[0], p[1] + d[1], p[2] + d[2]}), nearest->position);
  nearest->normal = normal_against(along, world_[nearest->triangle]);
  nearest->camera_normal = normal_against(d, in_camera_[nearest->triangle]);
  return nearest;
}

int RayCaster::count_hits(int x, int y) const {
  int count = 0;
  for (const Triangle& t : in_camera_) count += meet(t, x, y).has_value();
  return count;
}

bool RayCaster::sees(int x, int y) const {
  return !camera_.bent || camera_.bent(x + Q(1, 2), y + Q(1, 2));
}

std::optional<Hit> RayCaster::cast(int x, int y) const {
  if (camera_.bent) {
    const std::optional<Vector> d = camera_.bent(x + Q(1, 2), y + Q(1, 2));
    return d ? cast_bent(*d) : std::nullopt;
  }
  std::optional<Hit> nearest;
  for (std::uint32_t i = 0; i < in_camera_.size(); ++i) {
    const auto m = meet(in_camera_[i], x, y);
    if (!m || (nearest && m->depth >= nearest->depth)) continue;
    nearest =
        Hit{.triangle = i, .depth = m->depth, .weight_b = m->weight_b, .weight_c = m->weight_c};
  }
  if (!nearest) return nearest;
  Vector origin, direction;
  ray(x + Q(1, 2), y + Q(1, 2), origin, direction);
  Vector p;
  for (int i = 0; i < 3; ++i) p[i] = origin[i] + nearest->depth * direction[i];
  nearest->squared_distance = camera_.perspective ? dot(p, p) : Q(nearest->depth * nearest->depth);
  nearest->position = to_world(p);
  // The ray comes from a point of smaller depth.
  const Vector along =
      minus(to_world({p[0] + direction[0], p[1] + direction[1], p[2] + 1}), nearest->position);
  nearest->normal = normal_against(along, world_[nearest->triangle]);
  nearest->camera_normal = normal_against(direction, in_camera_[nearest->triangle]);
  return nearest;
}

}  // namespace fathom::oracle
