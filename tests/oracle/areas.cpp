#include "tests/oracle/areas.h"

#include <algorithm>
#include <functional>
#include <set>

namespace fathom::oracle {
namespace {

/// U, V, W and z of a corner.
using Corner = std::array<Q, 4>;

/// The part of a polygon where a·corner ≥ b.
std::vector<Corner> clip(const std::vector<Corner>& polygon, const std::array<Q, 4>& a,
                         const Q& b = 0) {
  const auto value = [&](const Corner& c) {
    return Q(a[0] * c[0] + a[1] * c[1] + a[2] * c[2] + a[3] * c[3] - b);
  };
  std::vector<Corner> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Q at_p = value(p), at_q = value(q);
    if (sgn(at_p) >= 0) result.push_back(p);
    if (sgn(at_p) * sgn(at_q) < 0) {
      const Q t = at_p / (at_p - at_q);
      Corner crossing;
      for (std::size_t k = 0; k < 4; ++k) crossing[k] = p[k] + t * (q[k] - p[k]);
      result.push_back(crossing);
    }
  }
  return result;
}

struct Line {
  Q a, b, c;  // a·u + b·v + c = 0
};

/// The ordinate at which two lines cross, if they do so within the pixel.
void add_crossing(const Line& l, const Line& m, int x, int y, std::set<Q>& ordinates) {
  const Q weight = l.a * m.b - l.b * m.a;
  if (sgn(weight) == 0) return;
  const Q v = (l.c * m.a - l.a * m.c) / weight;
  const Q u = (l.b * m.c - l.c * m.b) / weight;
  if (v > y && v < y + 1 && u >= x && u <= x + 1) ordinates.insert(v);
}

std::vector<Line> edge_lines(const std::vector<Piece>& pieces) {
  std::vector<Line> lines;
  for (const Piece& piece : pieces) {
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
      const Point &p = piece.corners[i], &q = piece.corners[(i + 1) % piece.corners.size()];
      lines.push_back({p[1] - q[1], q[0] - p[0], p[0] * q[1] - q[0] * p[1]});
    }
  }
  return lines;
}

/// Where the row v, not through a corner, enters and leaves a piece.
bool span_at(const Piece& piece, const Q& v, Q& from, Q& to) {
  std::vector<Q> crossings;
  for (std::size_t i = 0; i < piece.corners.size(); ++i) {
    const Point &p = piece.corners[i], &q = piece.corners[(i + 1) % piece.corners.size()];
    if ((p[1] < v) == (q[1] < v)) continue;
    crossings.push_back(p[0] + (v - p[1]) / (q[1] - p[1]) * (q[0] - p[0]));
  }
  if (crossings.size() != 2) return false;
  from = std::min(crossings[0], crossings[1]);
  to = std::max(crossings[0], crossings[1]);
  return true;
}

/// Sums what `length` says of the row in the middle of each slab, times its height: exact where
/// nothing crosses between the ordinates.
void over_slabs(const std::set<Q>& ordinates,
                const std::function<void(const Q& v, const Q& height)>& visit) {
  if (ordinates.empty()) return;
  for (auto next = std::next(ordinates.begin()); next != ordinates.end(); ++next) {
    const Q &low = *std::prev(next), &high = *next;
    visit((low + high) / 2, high - low);
  }
}

}  // namespace

Q twice_area(const std::vector<Point>& polygon) {
  Q sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += p[0] * q[1] - p[1] * q[0];
  }
  return sum;
}

Areas::Areas(const RayCamera& camera, const std::vector<Triangle>& triangles) : camera_(camera) {
  for (const Triangle& world : triangles) {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t r = 0; r < 3; ++r) {
        const auto& row = camera.world_to_camera[r];
        t[i][r] = row[0] * world[i][0] + row[1] * world[i][1] + row[2] * world[i][2] + row[3];
      }
    }
    in_camera_.push_back(t);
  }
}

/// The triangle clipped against the pixel's sides and the range of depths, then divided. No corner
/// has W = 0 but where the triangle's plane goes through the eye, and then there is no area.
std::vector<Point> Areas::project(const Triangle& t, int x, int y) const {
  const Q shift = Q(1, 2) - camera_.pixel_centre;
  const Q cx = camera_.cx + shift, cy = camera_.cy + shift;
  std::vector<Corner> polygon;
  for (const Vector& p : t) {
    const Q w = camera_.perspective ? p[2] : Q(1);
    polygon.push_back(
        {camera_.fx * p[0] + camera_.skew * p[1] + cx * w, camera_.fy * p[1] + cy * w, w, p[2]});
  }
  polygon = clip(polygon, {0, 0, 0, 1});       // z ≥ 0
  polygon = clip(polygon, {1, 0, -x, 0});      // U ≥ x·W
  polygon = clip(polygon, {-1, 0, x + 1, 0});  // U ≤ (x + 1)·W
  polygon = clip(polygon, {0, 1, -y, 0});
  polygon = clip(polygon, {0, -1, y + 1, 0});
  polygon = clip(polygon, {0, 0, 0, 1}, camera_.near);
  if (camera_.far) polygon = clip(polygon, {0, 0, 0, -1}, -*camera_.far);
  std::vector<Point> image;
  bool all_at_zero = true;
  for (const Corner& c : polygon) {
    if (sgn(c[2]) == 0) return {};
    all_at_zero &= sgn(c[3]) == 0;
    image.push_back({c[0] / c[2], c[1] / c[2]});
  }
  if (all_at_zero || sgn(twice_area(image)) == 0) return {};
  return image;
}

/// 1/D is affine on the image under perspective, D is under an orthographic projection: from the
/// plane n·X = n·A and the ray of (u, v) at the three points (0, 0), (1, 0), (0, 1).
bool Areas::key_of(const Triangle& t, std::array<Q, 3>& key) const {
  Vector e, f;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = t[1][k] - t[0][k];
    f[k] = t[2][k] - t[0][k];
  }
  const Vector n{e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
  const Q d = n[0] * t[0][0] + n[1] * t[0][1] + n[2] * t[0][2];
  const Q shift = Q(1, 2) - camera_.pixel_centre;
  const auto at = [&](int u, int v) {
    const Q y = (v - camera_.cy - shift) / camera_.fy;
    const Q x = (u - camera_.cx - shift - camera_.skew * y) / camera_.fx;
    if (camera_.perspective) return Q(-(n[0] * x + n[1] * y + n[2]) / d);  // −1/D
    return Q((d - n[0] * x - n[1] * y) / n[2]);
  };
  if (sgn(camera_.perspective ? d : n[2]) == 0) return false;
  const Q origin = at(0, 0);
  key = {at(1, 0) - origin, at(0, 1) - origin, origin};
  return true;
}

std::vector<Piece> Areas::pieces(int x, int y) const {
  std::vector<Piece> result;
  for (std::size_t i = 0; i < in_camera_.size(); ++i) {
    Piece piece{static_cast<std::uint32_t>(i), {}, {}};
    if (!key_of(in_camera_[i], piece.key)) continue;
    piece.corners = project(in_camera_[i], x, y);
    if (!piece.corners.empty()) result.push_back(std::move(piece));
  }
  return result;
}

Q Areas::unoccluded(std::uint32_t triangle, int x, int y) const {
  std::array<Q, 3> key;
  if (!key_of(in_camera_[triangle], key)) return 0;
  return abs(twice_area(project(in_camera_[triangle], x, y))) / 2;
}

Q Areas::coverage(int x, int y) const {
  const std::vector<Piece> all = pieces(x, y);
  const std::vector<Line> lines = edge_lines(all);
  std::set<Q> ordinates{Q(y), Q(y + 1)};
  for (const Piece& piece : all) {
    for (const Point& p : piece.corners) ordinates.insert(p[1]);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) add_crossing(lines[i], lines[k], x, y, ordinates);
  }
  Q area = 0;
  over_slabs(ordinates, [&](const Q& v, const Q& height) {
    std::vector<std::array<Q, 2>> spans;
    Q from, to;
    for (const Piece& piece : all) {
      if (span_at(piece, v, from, to)) spans.push_back({from, to});
    }
    std::sort(spans.begin(), spans.end());
    Q length = 0, reached = x;
    for (const auto& [first, last] : spans) {
      if (last <= reached) continue;
      length += last - std::max(first, reached);
      reached = last;
    }
    area += length * height;
  });
  return area;
}

std::map<std::uint32_t, Q> Areas::visible(int x, int y) const {
  const std::vector<Piece> all = pieces(x, y);
  std::vector<Line> lines = edge_lines(all);
  const std::size_t edges = lines.size();
  // Where two triangles are equally deep they may change places.
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto &p = all[i].key, &q = all[k].key;
      lines.push_back({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
    }
  }
  const std::vector<Line> changes(lines.begin() + static_cast<std::ptrdiff_t>(edges), lines.end());
  std::set<Q> ordinates{Q(y), Q(y + 1)};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) add_crossing(lines[i], lines[k], x, y, ordinates);
  }
  // Corners on the pixel's sides are crossings with lines that are not in the list.
  for (const Piece& piece : all) {
    for (const Point& p : piece.corners) ordinates.insert(p[1]);
  }
  for (const Line& l : changes) {
    for (int side = x; side <= x + 1; ++side) add_crossing(l, {1, 0, -side}, x, y, ordinates);
  }
  std::map<std::uint32_t, Q> areas;
  over_slabs(ordinates, [&](const Q& v, const Q& height) {
    std::set<Q> cuts{Q(x), Q(x + 1)};
    std::vector<std::pair<std::array<Q, 2>, const Piece*>> spans;
    Q from, to;
    for (const Piece& piece : all) {
      if (!span_at(piece, v, from, to)) continue;
      spans.push_back({{from, to}, &piece});
      cuts.insert(from);
      cuts.insert(to);
    }
    for (const Line& l : changes) {
      if (sgn(l.a) == 0) continue;
      const Q u = -(l.b * v + l.c) / l.a;
      if (u > x && u < x + 1) cuts.insert(u);
    }
    for (auto next = std::next(cuts.begin()); next != cuts.end(); ++next) {
      const Q u = (*std::prev(next) + *next) / 2;
      const Piece* nearest = nullptr;
      Q least;
      for (const auto& [span, piece] : spans) {
        if (u < span[0] || u > span[1]) continue;
        const Q key = piece->key[0] * u + piece->key[1] * v + piece->key[2];
        if (nearest && key >= least) continue;
        nearest = piece;
        least = key;
      }
      if (nearest) areas[nearest->triangle] += (*next - *std::prev(next)) * height;
    }
  });
  return areas;
}

}  // namespace fathom::oracle
