#include "tests/oracle/close_behind.h"

#include <algorithm>
#include <map>

namespace fathom::oracle {
namespace {

bool has_area(const Polygon& polygon) {
  return sgn(twice_area(polygon)) != 0;
}

/// The sides of a convex polygon as lines a·u + b·v + c ≥ 0 within it.
std::vector<std::array<Q, 3>> sides(const Polygon& polygon) {
  const int way = sgn(twice_area(polygon));
  std::vector<std::array<Q, 3>> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    if (p == q) continue;
    result.push_back({way * (p[1] - q[1]), way * (q[0] - p[0]), way * (p[0] * q[1] - q[0] * p[1])});
  }
  return result;
}

Polygon common(Polygon a, const Polygon& b) {
  for (const auto& [x, y, z] : sides(b)) a = clipped(a, x, y, z);
  return a;
}

/// What is left of convex parts without a convex polygon.
std::vector<Polygon> without(const std::vector<Polygon>& parts, const Polygon& taken) {
  std::vector<Polygon> result;
  for (Polygon rest : parts) {
    for (const auto& [x, y, z] : sides(taken)) {
      Polygon outside = clipped(rest, -x, -y, -z);
      if (has_area(outside)) result.push_back(std::move(outside));
      rest = clipped(rest, x, y, z);
    }
  }
  return result;
}

/// The part of `behind` that is not in front of `front`.
Polygon part_behind(const Piece& behind, const Piece& front) {
  return clipped(behind.corners, behind.key[0] - front.key[0], behind.key[1] - front.key[1],
                 behind.key[2] - front.key[2]);
}

/// Where a piece is visible.
std::vector<Polygon> visible_parts(const Piece& piece, const std::vector<Piece>& all) {
  std::vector<Polygon> parts{piece.corners};
  for (const Piece& other : all) {
    if (other.triangle == piece.triangle) continue;
    if (other.key == piece.key) {
      if (other.triangle < piece.triangle) parts = without(parts, other.corners);
      continue;
    }
    // Of the other what is not behind this one.
    const Polygon hides = clipped(other.corners, piece.key[0] - other.key[0],
                                  piece.key[1] - other.key[1], piece.key[2] - other.key[2]);
    if (has_area(hides)) parts = without(parts, hides);
  }
  return parts;
}

Point middle(const Point& p, const Point& q) {
  return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
}

}  // namespace

/// Not negative where D_behind − D_visible ≤ limit. With k = 1/D > 0 that is, times both k,
/// k_visible − k_behind ≤ limit·k_visible·k_behind; a polynomial of degree 2 at most.
Q Behind::excess(const Point& p, const Q& limit) const {
  const auto at = [&](const std::array<Q, 3>& key) {
    return Q(key[0] * p[0] + key[1] * p[1] + key[2]);
  };
  const Q front = at(visible_key), back = at(behind_key);
  if (!perspective) return limit - (back - front);
  return limit * front * back + front - back;
}

/// The greatest excess lies on the rim: within it both gradients, of 1/k_visible and of 1/k_behind,
/// would have to be equal, so that the difference would be the same along a line across the part.
/// On a side it is found from the values at both ends and in the middle.
bool Behind::reaches(const Polygon& part, const Q& limit, bool closed) const {
  const int least = closed ? 0 : 1;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Point &p = part[i], &q = part[(i + 1) % part.size()];
    const Q first = excess(p, limit), last = excess(q, limit);
    if (sgn(first) >= least || sgn(last) >= least) return true;
    const Q half = excess(middle(p, q), limit);
    const Q a = 2 * first + 2 * last - 4 * half, b = 4 * half - 3 * first - last;
    if (sgn(a) >= 0) continue;
    const Q at = -b / (2 * a);
    if (sgn(at) > 0 && at < 1 && sgn(first - b * b / (4 * a)) >= least) return true;
  }
  return false;
}

/// A polynomial of degree 2 that is 0 at three points of each side is 0 on at least three lines,
/// and so everywhere.
bool Behind::is_constantly(const Polygon& part, const Q& limit) const {
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Point &p = part[i], &q = part[(i + 1) % part.size()];
    if (sgn(excess(p, limit)) != 0 || sgn(excess(middle(p, q), limit)) != 0) return false;
  }
  return true;
}

bool Behind::reaches(const Q& limit, bool closed) const {
  return std::any_of(pixels.begin(), pixels.end(), [&](const InPixel& pixel) {
    return std::any_of(pixel.parts.begin(), pixel.parts.end(),
                       [&](const Polygon& part) { return reaches(part, limit, closed); });
  });
}

bool Behind::is_close(const InPixel& pixel, const Q& limit) const {
  return std::any_of(pixel.parts.begin(), pixel.parts.end(), [&](const Polygon& part) {
    return reaches(part, limit, false) || is_constantly(part, limit);
  });
}

std::vector<Behind> behind_visible(const Areas& areas, bool perspective, int width, int height,
                                   int way) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Behind> found;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::vector<Piece> pieces = areas.pieces(x, y);
      std::erase_if(pieces, [&](const Piece& piece) {
        return way != 0 && sgn(twice_area(piece.corners)) != way;
      });
      for (const Piece& t : pieces) {
        const std::vector<Polygon> visible = visible_parts(t, pieces);
        for (const Piece& s : pieces) {
          if (s.triangle == t.triangle) continue;
          const Polygon behind = part_behind(s, t);
          if (!has_area(behind)) continue;
          Behind::InPixel pixel{x, y, {}};
          for (const Polygon& part : visible) {
            Polygon both = common(part, behind);
            if (has_area(both)) pixel.parts.push_back(std::move(both));
          }
          if (pixel.parts.empty()) continue;
          Behind& pair = found[{t.triangle, s.triangle}];
          pair.visible = t.triangle;
          pair.behind = s.triangle;
          pair.perspective = perspective;
          pair.visible_key = t.key;
          pair.behind_key = s.key;
          pair.pixels.push_back(std::move(pixel));
        }
      }
    }
  }
  std::vector<Behind> result;
  for (auto& [numbers, pair] : found) result.push_back(std::move(pair));
  return result;
}

}  // namespace fathom::oracle
