#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/geometry/frames.h"
#include "tests/inputs/draw.h"

/// Faces of four corners and more, each drawn from a family that is hard for a reason of its own.
namespace fathom::checks {

using Ring = std::vector<MeshPoint>;

/// A ring that meets itself, and touches itself, as it likes.
inline Ring any_walk(Draw& draw) {
  Ring ring;
  for (int n = draw.between(4, 9); n > 0; --n) ring.push_back({draw.few_bits(4), draw.few_bits(4)});
  return ring;
}

/// Corners in the order of their angles; all of a size where it is convex.
inline Ring star(Draw& draw) {
  const int corners = draw.between(4, 14);
  const bool convex = draw.one_in(3), whole = draw.one_in(2);
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners;
    const double radius = convex ? 64 : 4 + draw.below(60);
    MeshPoint p{radius * std::cos(angle), radius * std::sin(angle)};
    if (whole) p = {std::round(p.x), std::round(p.y)};
    ring.push_back(p);
  }
  return ring;
}

/// Teeth on a straight side, some of no height: ears that others lie in, and straight runs.
inline Ring comb(Draw& draw) {
  const int teeth = draw.between(2, 6);
  Ring ring;
  for (int k = 0; k < teeth; ++k) {
    ring.push_back({2.0 * k, 0});
    ring.push_back({2.0 * k + 1, static_cast<double>(draw.below(4))});
  }
  ring.push_back({2.0 * teeth, 0});
  ring.push_back({2.0 * teeth, 5});
  ring.push_back({0, 5});
  return ring;
}

/// Twice a way that turns inwards: every corner has few neighbours that it sees.
inline Ring spiral(Draw& draw) {
  const int turns = draw.between(4, 9);
  const double width = draw.one_in(2) ? 0.5 : 0x1p-30;
  Ring outside, inside;
  for (int k = 0; k < turns; ++k) {
    const double reach = 2 + turns - k, x = k % 4 == 0 || k % 4 == 3 ? 1 : -1,
                 y = k % 4 < 2 ? 1 : -1;
    outside.push_back({reach * x, reach * y});
    inside.push_back({(reach - width) * x, (reach - width) * y});
  }
  outside.insert(outside.end(), inside.rbegin(), inside.rend());
  return outside;
}

/// All corners on a line, out and back.
inline Ring line(Draw& draw) {
  Ring ring;
  const double slope = draw.few_bits(2);
  for (int n = draw.between(4, 9); n > 0; --n) {
    const double x = draw.one_in(2) ? draw.few_bits(8) : draw.within(8);
    ring.push_back({x, slope * x});
  }
  return ring;
}

/// Corners that repeat others, and corners on sides.
inline void crowd(Draw& draw, Ring& ring) {
  for (int n = draw.below(4); n > 0; --n) {
    const auto at = static_cast<std::size_t>(draw.below(static_cast<int>(ring.size())));
    const MeshPoint a = ring[at], b = ring[(at + 1) % ring.size()];
    const double t = draw.one_in(2) ? 0 : draw.one_in(2) ? 0.5 : draw.unit();
    const MeshPoint between{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(at) + 1, between);
  }
}

/// Into space: onto a plane whose normal may have components of one size, or off any plane.
inline void lift(Draw& draw, Ring& ring) {
  const double a = draw.between(-2, 2) * 0.5, b = draw.between(-2, 2) * 0.5;
  const double off = draw.one_in(3) ? 1 : 0;
  const int turn = draw.below(3);
  for (MeshPoint& p : ring) {
    p.z = a * p.x + b * p.y + off * draw.few_bits(8);
    if (turn == 1) p = {p.y, p.z, p.x};
    if (turn == 2) p = {p.z, p.x, p.y};
  }
  if (draw.one_in(2)) std::reverse(ring.begin(), ring.end());
  std::rotate(ring.begin(), ring.begin() + draw.below(static_cast<int>(ring.size())), ring.end());
}

enum class FaceFamily {
  plain,         // few bits: straight runs, repeated and touching corners
  nudged,        // a few units in the last place off that
  cancellation,  // far from the origin
  scales,        // each axis with an exponent of its own
  tiny_parts,    // some corners next to the origin, down to subnormal numbers
  exponents,     // exponents from −1060 to 1020, each by itself
};

inline constexpr FaceFamily all_face_families[] = {FaceFamily::plain,        FaceFamily::nudged,
                                                   FaceFamily::cancellation, FaceFamily::scales,
                                                   FaceFamily::tiny_parts,   FaceFamily::exponents};
inline std::string name_of(FaceFamily family) {
  constexpr const char* names[] = {"plain",  "nudged",     "cancellation",
                                   "scales", "tiny_parts", "exponents"};
  return names[static_cast<std::size_t>(family)];
}

inline void for_each_coordinate(Ring& ring, const auto& change) {
  for (MeshPoint& p : ring) change(p.x), change(p.y), change(p.z);
}

inline void make_hard(FaceFamily family, Draw& draw, Ring& ring) {
  switch (family) {
    case FaceFamily::plain:
      return;
    case FaceFamily::nudged:
      return for_each_coordinate(ring, [&](double& x) { x = draw.nudged(x, 3); });
    case FaceFamily::cancellation: {
      const double far = std::ldexp(1, draw.between(20, 52));
      const MeshPoint offset{draw.few_bits(far), draw.few_bits(far), draw.few_bits(far)};
      for (MeshPoint& p : ring) p = {p.x + offset.x, p.y + offset.y, p.z + offset.z};
      return;
    }
    case FaceFamily::scales: {
      int e[3];
      for (int& axis : e) axis = draw.one_in(3) ? 0 : draw.between(-1060, 1010);
      if (draw.one_in(2)) e[1] = e[2] = e[0];
      for (MeshPoint& p : ring)
        p = {std::ldexp(p.x, e[0]), std::ldexp(p.y, e[1]), std::ldexp(p.z, e[2])};
      return;
    }
    case FaceFamily::tiny_parts: {
      const int e = draw.between(-1070, -20);
      for (MeshPoint& p : ring) {
        if (draw.one_in(2)) p = {std::ldexp(p.x, e), std::ldexp(p.y, e), std::ldexp(p.z, e)};
      }
      return;
    }
    case FaceFamily::exponents:
      return for_each_coordinate(ring, [&](double& x) {
        if (draw.one_in(3)) x = draw.one_in(4) ? 0 : draw.of_exponent(draw.between(-1060, 1020));
      });
  }
}

/// Finite corners, four at least.
inline Ring hard_face(FaceFamily family, std::uint64_t seed) {
  Draw draw(seed << 8 | static_cast<std::uint64_t>(family));
  constexpr Ring (*shapes[])(Draw&) = {any_walk, star, comb, spiral, line};
  Ring ring = draw.one_of(shapes)(draw);
  crowd(draw, ring);
  lift(draw, ring);
  make_hard(family, draw, ring);
  return ring;
}

}  // namespace fathom::checks
