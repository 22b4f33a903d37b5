#include "tests/area/slab_areas.h"

#include <algorithm>
#include <set>

#include "tests/oracle/clipped_polygon.h"

namespace fathom::checks {
namespace {

using oracle::Point;
using oracle::Polygon;
using oracle::Q;
using oracle::Triangle;
using oracle::Vector;

/// a·u + b·v + c
struct Affine {
  Q a, b, c;
  [[nodiscard]] Q at(const Point& p) const { return a * p[0] + b * p[1] + c; }
  [[nodiscard]] bool is_constant() const { return sgn(a) == 0 && sgn(b) == 0; }
};

Affine operator-(const Affine& x, const Affine& y) {
  return {x.a - y.a, x.b - y.b, x.c - y.c};
}

/// The function that is 0 on the line from p to q.
Affine line_of(const Point& p, const Point& q) {
  return {p[1] - q[1], q[0] - p[0], p[0] * q[1] - q[0] * p[1]};
}

/// The function with these values at three points that are not in line.
Affine through(const std::array<Point, 3>& p, const std::array<Q, 3>& values) {
  const Q u1 = p[1][0] - p[0][0], v1 = p[1][1] - p[0][1], u2 = p[2][0] - p[0][0],
          v2 = p[2][1] - p[0][1], d1 = values[1] - values[0], d2 = values[2] - values[0];
  const Q det = u1 * v2 - u2 * v1;
  const Q a = (d1 * v2 - d2 * v1) / det, b = (u1 * d2 - u2 * d1) / det;
  return {a, b, values[0] - a * p[0][0] - b * p[0][1]};
}

/// A triangle on the plane of the light.
struct Shadow {
  std::uint32_t number = 0;
  std::array<Point, 3> corners;
  Affine depth;
  /// The coordinates of its points in the world.
  std::array<Affine, 3> place;

  [[nodiscard]] bool contains(const Point& p) const {
    int sides = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sides += sgn(line_of(corners[k], corners[(k + 1) % 3]).at(p));
    return sides == 3 || sides == -3;
  }
};

std::vector<Shadow> shadows_of(const std::vector<Triangle>& triangles, const Vector& d) {
  std::size_t k = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (abs(d[axis]) > abs(d[k])) k = axis;
  }
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  std::vector<Shadow> shadows;
  for (std::uint32_t number = 0; number < triangles.size(); ++number) {
    Shadow shadow{number, {}, {}, {}};
    std::array<Q, 3> depths;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector& x = triangles[number][corner];
      shadow.corners[corner] = {x[i] * d[k] - x[k] * d[i], x[j] * d[k] - x[k] * d[j]};
      depths[corner] = -sgn(d[k]) * x[k];
    }
    if (sgn(oracle::twice_area({shadow.corners.begin(), shadow.corners.end()})) == 0) continue;
    shadow.depth = through(shadow.corners, depths);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      shadow.place[axis] = through(
          shadow.corners,
          {triangles[number][0][axis], triangles[number][1][axis], triangles[number][2][axis]});
    }
    shadows.push_back(shadow);
  }
  return shadows;
}

/// The lines at which something may change.
std::vector<Affine> lines_of(const std::vector<Shadow>& shadows) {
  std::vector<Affine> lines;
  for (const Shadow& s : shadows) {
    for (std::size_t k = 0; k < 3; ++k)
      lines.push_back(line_of(s.corners[k], s.corners[(k + 1) % 3]));
    for (const Shadow& t : shadows) {
      const Affine change = s.depth - t.depth;
      if (s.number < t.number && !change.is_constant()) lines.push_back(change);
    }
  }
  return lines;
}

/// Where a line that is not level crosses the row v.
Q crossing(const Affine& line, const Q& v) {
  return -(line.b * v + line.c) / line.a;
}

std::set<Q> ordinates_of(const std::vector<Shadow>& shadows, const std::vector<Affine>& lines) {
  std::set<Q> ordinates;
  for (const Shadow& s : shadows) {
    for (const Point& p : s.corners) ordinates.insert(p[1]);
  }
  if (ordinates.empty()) return ordinates;
  const Q low = *ordinates.begin(), high = *ordinates.rbegin();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Q weight = lines[i].a * lines[k].b - lines[k].a * lines[i].b;
      if (sgn(weight) == 0) continue;
      const Q v = (lines[i].c * lines[k].a - lines[k].c * lines[i].a) / weight;
      if (v > low && v < high) ordinates.insert(v);
    }
  }
  return ordinates;
}

const Shadow* nearest_at(const std::vector<Shadow>& shadows, const Point& p) {
  const Shadow* nearest = nullptr;
  for (const Shadow& s : shadows) {
    if (s.contains(p) && (!nearest || s.depth.at(p) < nearest->depth.at(p))) nearest = &s;
  }
  return nearest;
}

/// Adds a polygon in which a triangle is visible.
void add(SlabArea& area, const Shadow& shadow, const Polygon& polygon) {
  const Q whole = oracle::twice_area({shadow.corners.begin(), shadow.corners.end()});
  Q twice = 0;
  Point sixfold{0, 0};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Q product = p[0] * q[1] - p[1] * q[0];
    twice += product;
    for (std::size_t axis = 0; axis < 2; ++axis) sixfold[axis] += product * (p[axis] + q[axis]);
  }
  if (sgn(twice) == 0) return;
  const Q share = abs(twice / whole);
  const Point centre{sixfold[0] / (3 * twice), sixfold[1] / (3 * twice)};
  area.share += share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    area.moment[axis] += share * shadow.place[axis].at(centre);
  }
}

}  // namespace

std::vector<SlabArea> slab_areas(const std::vector<Triangle>& triangles, const Vector& direction) {
  const std::vector<Shadow> shadows = shadows_of(triangles, direction);
  const std::vector<Affine> lines = lines_of(shadows);
  const std::set<Q> ordinates = ordinates_of(shadows, lines);
  std::vector<SlabArea> areas(triangles.size());
  for (auto next = ordinates.begin(); next != ordinates.end(); ++next) {
    if (next == ordinates.begin()) continue;
    const Q &low = *std::prev(next), &high = *next, middle = (low + high) / 2;
    std::vector<std::pair<Q, const Affine*>> cuts;
    for (const Affine& line : lines) {
      if (sgn(line.a) != 0) cuts.emplace_back(crossing(line, middle), &line);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const auto& [from, left] = cuts[k - 1];
      const auto& [to, right] = cuts[k];
      if (from == to) continue;
      const Shadow* nearest = nearest_at(shadows, {(from + to) / 2, middle});
      if (!nearest) continue;
      add(areas[nearest->number], *nearest,
          {{crossing(*left, low), low},
           {crossing(*right, low), low},
           {crossing(*right, high), high},
           {crossing(*left, high), high}});
    }
  }
  return areas;
}

}  // namespace fathom::checks
