#include "tests/area/judged_edges.h"

#include <algorithm>
#include <functional>
#include <set>

namespace fathom::checks {
namespace {

using oracle::Point;
using oracle::Q;
using oracle::Triangle;
using oracle::Vector;

/// An affine function a·u + b·v + c of the image.
using Affine = std::array<Q, 3>;

Q at(const Affine& f, const Point& p) {
  return f[0] * p[0] + f[1] * p[1] + f[2];
}
bool is_constant(const Affine& f) {
  return sgn(f[0]) == 0 && sgn(f[1]) == 0;
}
/// From its values.
Affine affine(const std::function<Q(const Point&)>& f) {
  const Q here = f({0, 0});
  return {f({1, 0}) - here, f({0, 1}) - here, here};
}
/// The line of f = 0, in one way: its first coefficient that is not 0 is 1.
Affine line_of(const Affine& f) {
  const Q scale = sgn(f[0]) != 0 ? f[0] : f[1];
  return {f[0] / scale, f[1] / scale, f[2] / scale};
}

Q det(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}
Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct Ray {
  Vector origin, direction;
};

Ray ray_at(const oracle::RayCamera& camera, const Point& p) {
  const Q shift = camera.pixel_centre - Q(1, 2);
  const Q y = (p[1] + shift - camera.cy) / camera.fy;
  const Q x = (p[0] + shift - camera.cx - camera.skew * y) / camera.fx;
  if (camera.perspective) return {{0, 0, 0}, {x, y, 1}};
  return {{x, y, 0}, {0, 0, 1}};
}

/// A triangle where none of `inside` is negative, with its depth over ÷ under, under > 0 there.
struct Seen {
  std::uint32_t number;
  std::vector<Affine> inside;
  Affine over, under;
  /// Its corners, if all of it is in front of the camera.
  std::optional<std::array<Point, 3>> corners;

  [[nodiscard]] bool ends_at(const Affine& line) const {
    return std::any_of(inside.begin(), inside.end(),
                       [&](const Affine& f) { return !is_constant(f) && line_of(f) == line; });
  }
  [[nodiscard]] Q depth(const Point& p) const { return at(over, p) / at(under, p); }
  /// Whether it is on a side of a line at one of its points, on no other line.
  [[nodiscard]] bool is_at(const Point& p, const Point& towards) const {
    return std::all_of(inside.begin(), inside.end(), [&](const Affine& f) {
      const Q value = at(f, p);
      if (sgn(value) != 0) return sgn(value) > 0;
      return sgn(f[0] * towards[0] + f[1] * towards[1]) >= 0;
    });
  }
  /// How the depth grows on the way towards a side.
  [[nodiscard]] Q growth(const Point& p, const Point& towards) const {
    const Q of_over = over[0] * towards[0] + over[1] * towards[1],
            of_under = under[0] * towards[0] + under[1] * towards[1];
    const Q w = at(under, p);
    return (of_over * w - at(over, p) * of_under) / (w * w);
  }
};

/// Whether two triangles certainly have no area in common: one is outside an edge of the other.
bool are_apart(const Seen& s, const Seen& t) {
  const auto is_outside = [](const Seen& of, const std::array<Point, 3>& corners) {
    return std::any_of(of.inside.begin(), of.inside.begin() + 3, [&](const Affine& edge) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](const Point& corner) { return sgn(at(edge, corner)) <= 0; });
    });
  };
  return s.corners && t.corners && (is_outside(s, *t.corners) || is_outside(t, *s.corners));
}

std::optional<std::array<Point, 3>> corners_of(const oracle::RayCamera& camera, const Triangle& t) {
  const Q shift = camera.pixel_centre - Q(1, 2);
  std::array<Point, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    if (camera.perspective && sgn(t[k][2]) <= 0) return std::nullopt;
    const Q scale = camera.perspective ? Q(1 / t[k][2]) : Q(1);
    const Q x = t[k][0] * scale, y = t[k][1] * scale;
    corners[k] = {camera.fx * x + camera.skew * y + camera.cx - shift,
                  camera.fy * y + camera.cy - shift};
  }
  return corners;
}

Affine plus(const Affine& f, const Q& k, const Affine& g) {
  return {f[0] + k * g[0], f[1] + k * g[1], f[2] + k * g[2]};
}

std::optional<Seen> seen(const JudgedScene& scene, std::uint32_t number) {
  const oracle::RayCamera& camera = scene.camera;
  Triangle t;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vector& x = scene.triangles[number][corner];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = camera.world_to_camera[i];
      t[corner][i] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3];
    }
  }
  // The weight of a corner times D·Δ: the volume of the ray and the other two corners.
  std::array<Affine, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = affine([&](const Point& p) -> Q {
      const Ray ray = ray_at(camera, p);
      return det(ray.direction, minus(t[(i + 1) % 3], ray.origin),
                 minus(t[(i + 2) % 3], ray.origin));
    });
  }
  const Affine sum = plus(plus(weights[0], 1, weights[1]), 1, weights[2]);
  const Q whole = camera.perspective ? det(t[0], t[1], t[2]) : sum[2];
  if (sgn(whole) == 0) return std::nullopt;
  const Q side = sgn(whole);
  const Affine nothing{0, 0, 0};
  Seen result{number, {}, nothing, plus(nothing, side, sum), corners_of(camera, t)};
  for (std::size_t i = 0; i < 3; ++i) {
    result.inside.push_back(plus(nothing, side, weights[i]));
    if (!camera.perspective) result.over = plus(result.over, side * t[i][2], weights[i]);
  }
  if (camera.perspective) {
    result.over[2] = abs(whole);
  } else {
    result.inside.push_back(result.over);
  }
  result.inside.push_back(plus(result.over, -camera.near, result.under));
  if (camera.far) {
    result.inside.push_back(plus(plus(nothing, *camera.far, result.under), -1, result.over));
  }
  for (const Affine& f : result.inside) {
    if (is_constant(f) && sgn(f[2]) < 0) return std::nullopt;
  }
  return result;
}

using Front = std::optional<std::size_t>;

class Judge {
 public:
  explicit Judge(const JudgedScene& scene) : scene_(scene) {
    for (std::uint32_t number = 0; number < scene.triangles.size(); ++number) {
      if (auto one = seen(scene, number)) seen_.push_back(std::move(*one));
    }
    for (const Seen& s : seen_) {
      for (const Affine& f : s.inside) add_line(f);
      for (const Seen& t : seen_) {
        if (s.number >= t.number || are_apart(s, t)) continue;
        // Affine: over or under is constant.
        add_line(affine([&](const Point& p) -> Q {
          return at(s.over, p) * at(t.under, p) - at(t.over, p) * at(s.under, p);
        }));
      }
    }
  }

  std::vector<JudgedEdge> edges() {
    for (const Affine& line : lines_) walk(line);
    return std::move(edges_);
  }

 private:
  void add_line(const Affine& f) {
    if (!is_constant(f)) lines_.insert(line_of(f));
  }

  /// Cuts a line where others cross it, and at the rim of the image.
  void walk(const Affine& line) {
    const Q width = scene_.width, height = scene_.height;
    std::set<Affine> others = lines_;
    for (const Affine& rim :
         {Affine{1, 0, 0}, Affine{1, 0, -width}, Affine{0, 1, 0}, Affine{0, 1, -height}}) {
      others.insert(rim);
    }
    std::set<Point> ends;
    for (const Affine& other : others) {
      const Q w = line[0] * other[1] - line[1] * other[0];
      if (sgn(w) == 0) continue;
      const Point p{(line[1] * other[2] - line[2] * other[1]) / w,
                    (line[2] * other[0] - line[0] * other[2]) / w};
      if (p[0] >= 0 && p[0] <= width && p[1] >= 0 && p[1] <= height) ends.insert(p);
    }
    for (auto next = ends.begin(); next != ends.end(); ++next) {
      if (next != ends.begin()) judge(line, *std::prev(next), *next);
    }
  }

  void judge(const Affine& line, const Point& from, const Point& to) {
    const Point middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
    const bool is_on_rim = sgn(middle[0]) == 0 || middle[0] == scene_.width ||
                           sgn(middle[1]) == 0 || middle[1] == scene_.height;
    if (is_on_rim) return;
    const Front a = front(middle, {line[0], line[1]}), b = front(middle, {-line[0], -line[1]});
    if (a == b) return;
    if (!a || !b) {
      edges_.push_back({from, to, seen_[a ? *a : *b].number, std::nullopt, false});
      return;
    }
    // In the order of their numbers.
    const Seen &s = seen_[std::min(*a, *b)], &t = seen_[std::max(*a, *b)];
    const bool s_ends = s.ends_at(line), t_ends = t.ends_at(line);
    const Point quarter{(from[0] + middle[0]) / 2, (from[1] + middle[1]) / 2};
    const bool is_joined = s_ends && t_ends && s.depth(middle) == t.depth(middle) &&
                           s.depth(quarter) == t.depth(quarter) &&
                           scene_.objects[s.number] == scene_.objects[t.number];
    const bool is_of_t = t_ends && !s_ends;
    edges_.push_back(
        {from, to, is_of_t ? t.number : s.number, is_of_t ? s.number : t.number, is_joined});
  }

  [[nodiscard]] Front front(const Point& p, const Point& towards) const {
    Front nearest;
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      if (!seen_[k].is_at(p, towards)) continue;
      if (!nearest || is_nearer(seen_[k], seen_[*nearest], p, towards)) nearest = k;
    }
    return nearest;
  }

  static bool is_nearer(const Seen& s, const Seen& t, const Point& p, const Point& towards) {
    const Q difference = s.depth(p) - t.depth(p);
    if (sgn(difference) != 0) return sgn(difference) < 0;
    return s.growth(p, towards) < t.growth(p, towards);
  }

  const JudgedScene& scene_;
  std::vector<Seen> seen_;
  std::set<Affine> lines_;
  std::vector<JudgedEdge> edges_;
};

}  // namespace

std::vector<JudgedEdge> judged_edges(const JudgedScene& scene) {
  return Judge(scene).edges();
}

}  // namespace fathom::checks
