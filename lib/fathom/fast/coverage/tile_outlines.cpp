#include "fathom/fast/coverage/tile_outlines.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fathom/fast/coverage/square_edges.h"
#include "fathom/fast/lanes/each_bit.h"

namespace fathom::fast {
namespace {

using area_bounds::far, area_bounds::rounding_room, area_bounds::least_rise;

/// Maps each vertex of an object to the first requested vertex at the same place. Vertices at the
/// same place have the same image point if the same instructions transformed them; otherwise they
/// remain distinct.
class VertexAtPlace {
 public:
  VertexAtPlace(const ImageObject& object, std::size_t most, std::vector<std::uint32_t>& slots)
      : object_(object), slots_(slots) {
    slots_.assign(std::bit_ceil(most + most / 2 + 1), none);
  }
  std::uint32_t operator()(std::uint32_t vertex) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = hash_of(object_.vertices[vertex]) & mask;; i = (i + 1) & mask) {
      if (slots_[i] == none) slots_[i] = vertex;
      if (slots_[i] == vertex || are_at_same_place(slots_[i], vertex)) return slots_[i];
    }
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// The same for −0 and 0.
  static std::uint64_t hash_of(const ImageVertex& vertex) {
    const std::uint64_t hash = std::bit_cast<std::uint64_t>(vertex.u + 0.0) * 0x9E3779B97F4A7C15 +
                               std::bit_cast<std::uint64_t>(vertex.v + 0.0);
    return hash * 0x9E3779B97F4A7C15 >> 20;
  }
  [[nodiscard]] bool are_at_same_place(std::uint32_t a, std::uint32_t b) const {
    if (object_.vertices[a].u != object_.vertices[b].u) return false;
    const MeshPoint &p = object_.mesh.vertices[a], &q = object_.mesh.vertices[b];
    return p.x == q.x && p.y == q.y && p.z == q.z;
  }

  const ImageObject& object_;
  std::vector<std::uint32_t>& slots_;
};

}  // namespace

void TileOutlines::start(const PixelBox& area) {
  area_ = area;
  whole_ = whole_tile(area);
  left_.clear();
  edges_.clear();
}

std::size_t TileOutlines::size() const {
  std::size_t size = 0;
  for (const EdgesLeft& left : left_) size += left.edges.size();
  return size;
}

/// Puts the edges of triangles that are not open through the sieve.
void TileOutlines::sieve_edges(const ImageObject& object, std::span<const std::uint32_t> numbers,
                               std::span<const CoverageTriangle> classes) {
  sieve_.start(3 * numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    auto [a, b, c] = object.mesh.triangles[numbers[i] - object.first_number];
    if (classes[i].kind == CoverageClass::negative) {
      std::swap(b, c);
    } else if (classes[i].kind != CoverageClass::positive) {
      continue;
    }
    sieve_.add(a, b);
    sieve_.add(b, c);
    sieve_.add(c, a);
  }
}

std::vector<EdgeBalance::Edge>& TileOutlines::left_of(const ImageObject& object) {
  auto place = std::lower_bound(left_.begin(), left_.end(), object.first_number,
                                [](const EdgesLeft& left, std::uint32_t number) {
                                  return left.object->first_number < number;
                                });
  if (place == left_.end() || place->object != &object) place = left_.insert(place, {&object, {}});
  return place->edges;
}

// Most edges that remain in the sieve belong to triangles that reach beyond the tile, and do not
// meet the tile themselves; then their opposites do not meet it either.
void TileOutlines::add(const ImageObject& object, std::span<const std::uint32_t> numbers,
                       std::span<const CoverageTriangle> classes) {
  sieve_edges(object, numbers, classes);
  met_edges_.clear();
  sieve_.for_each_left([&](std::uint32_t from, std::uint32_t to) {
    if (!misses_tile(object.vertices[from], object.vertices[to])) met_edges_.push_back({from, to});
  });
  std::vector<EdgeBalance::Edge>& left = left_of(object);
  balance_.start(met_edges_.size() + left.size());
  for (const auto& [from, to, times] : left) balance_.add(from, to, times);
  for (const auto& [from, to, times] : met_edges_) balance_.add(from, to, times);
  left.clear();
  balance_.for_each_left([&](const EdgeBalance::Edge& edge) { left.push_back(edge); });
}

/// Whether the edge certainly meets no pixel of the tile because it lies beyond one side of it.
bool TileOutlines::misses_tile(const ImageVertex& p, const ImageVertex& q) const {
  const double margin = std::max(p.position_error(), q.position_error()) + rounding_room;
  const auto beyond = [&](double a, double b, std::uint32_t first, std::uint32_t last) {
    return std::max(a, b) + margin < first || std::min(a, b) - margin >= last + 1.0;
  };
  return beyond(p.u, q.u, area_.first_column, area_.last_column) ||
         beyond(p.v, q.v, area_.first_row, area_.last_row);
}

OutlineEdge TileOutlines::edge_of(const ImageObject& object, const EdgeBalance::Edge& edge) const {
  const ImageVertex &p = object.vertices[edge.from], &q = object.vertices[edge.to];
  const auto local = [&](const ImageVertex& vertex) {
    return SquarePoint{vertex.u - area_.first_column, vertex.v - area_.first_row};
  };
  const SquarePoint from = local(p), to = local(q);
  const double extent =
      std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
  const double error =
      std::max(p.position_error(), q.position_error()) + unit_roundoff<double> * extent;
  return {from, to, error, static_cast<int>(edge.times), &object, edge.from, edge.to};
}

/// The pixels that the rectangle around the edge meets, widened by `margin` on all sides.
TileBox TileOutlines::box_of(const OutlineEdge& edge, double margin) const {
  const auto [left, right] = std::minmax({edge.from.x, edge.to.x});
  const auto [top, bottom] = std::minmax({edge.from.y, edge.to.y});
  // Truncated where negative: these pixels lie outside the tile.
  const auto within = [](double x, int least, int greatest) {
    return static_cast<std::int16_t>(std::clamp(x, 1.0 * least, 1.0 * greatest));
  };
  const auto last = [&](double x, int greatest) {
    return x < 0 ? std::int16_t{-1} : within(x, 0, greatest);
  };
  return {within(left - margin, 0, TileShape::size), last(right + margin, whole_.right),
          within(top - margin, 0, TileShape::size), last(bottom + margin, whole_.bottom)};
}

// Every point of the exact edge lies within e, the error of its ends, of its counterpart on the
// computed edge in both coordinates. Within the heights of a row of pixels, widened by e on both
// sides, the computed edge lies between the x of its two ends there; these err by at most 5.1u·|Δx|
// for the product (see square_edges.h) and 4u of a coordinate for sums: less than rounding_room up
// to `far` (validation/proofs/areas/row_of_edge.gappa.in). So do the heights.
template <class Visit>
void TileOutlines::for_each_row(const OutlineEdge& edge, const Visit& visit) const {
  const SquarePoint &p = edge.from, &q = edge.to;
  const double e = edge.error + rounding_room;
  const auto [left_end, right_end] = std::minmax({p.x, q.x});
  const auto [top_end, bottom_end] = std::minmax({p.y, q.y});
  const bool is_far = !(std::max({-left_end, right_end, -top_end, bottom_end}) < far);
  const TileBox box = is_far ? whole_ : box_of(edge, e);
  if (box.is_empty()) return;
  const double rise = q.y - p.y, slope = (q.x - p.x) / rise;
  if (is_far || std::abs(rise) < least_rise) {
    const std::uint64_t columns = columns_between(box.left, box.right);
    for (int row = box.top; row <= box.bottom; ++row) visit(static_cast<std::size_t>(row), columns);
    return;
  }
  const double last = box.right;
  for (int row = box.top; row <= box.bottom; ++row) {
    const double above = row - e;
    const auto at = [&, low = top_end, high = bottom_end](double height) {
      return p.x + (std::min(std::max(height, low), high) - p.y) * slope;
    };
    const double x = at(above), y = at(above + 1 + 2 * e);
    const double left = std::min(x, y) - e, right = std::max(x, y) + e;
    if (left >= last + 1 || right < 0) continue;
    // Integer parts of numbers that are not negative.
    visit(static_cast<std::size_t>(row), columns_between(static_cast<int>(std::max(left, 0.0)),
                                                         static_cast<int>(std::min(right, last))));
  }
}

void TileOutlines::find_edges(const ImageObject& object,
                              const std::vector<EdgeBalance::Edge>& left) {
  if (left.empty()) return;
  // Vertices that the file repeats at the same place count as one vertex.
  VertexAtPlace vertex_at(object, 2 * left.size(), vertex_at_);
  balance_.start(left.size());
  for (const auto& [from, to, times] : left) balance_.add(vertex_at(from), vertex_at(to), times);
  balance_.for_each_left(
      [&](const EdgeBalance::Edge& edge) { edges_.push_back(edge_of(object, edge)); });
}

void TileOutlines::find_pixels(TileRows& pixels) {
  edges_.clear();
  for (const auto& [object, left] : left_) find_edges(*object, left);
  for (const OutlineEdge& edge : edges_) {
    for_each_row(edge, [&](std::size_t row, std::uint64_t columns) { pixels[row] |= columns; });
  }
}

void TileOutlines::list_edges(const TileRows& pixels) {
  edges_at_.clear();
  for (std::vector<std::uint32_t>& edges : edges_in_row_) edges.clear();
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    for_each_row(edges_[i], [&](std::size_t row, std::uint64_t columns) {
      edges_in_row_[row].push_back(i);
      for (const std::size_t column : EachBit(columns & pixels[row])) {
        edges_at_.add(static_cast<std::uint32_t>(row * TileShape::size + column), i);
      }
    });
  }
  edges_at_.sort();
}

// An edge counts if it crosses the horizontal line between the two points. Let its ends go straight
// from their computed to their exact places, by at most e in each coordinate. If they stay above
// and below the line, it crosses the line all the time, and on the same side of the point as long
// as it does not pass over it, which takes a distance of at most √2·e from the computed edge. With
// d = (dx, dy) along the edge, the point's distance is |f|/|d|, and |d| ≤ |dx| + |dy|; up to `far`,
// f errs by less than rounding_room·(|dx| + |dy|). The other point is half a pixel away from all
// edges.
std::optional<int> TileOutlines::difference(std::uint32_t row, const SquarePoint& point,
                                            std::uint32_t column) const {
  const double other = column + 0.5;
  int sum = 0;
  for (const std::uint32_t i : edges_in_row_[row]) {
    const auto& [from, to, error, times, object, from_vertex, to_vertex] = edges_[i];
    const double margin = 2 * error + rounding_room;
    const double above = point.y - from.y, below = to.y - point.y;
    const double size =
        std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
    if (!(size < far) || std::abs(above) <= margin || std::abs(below) <= margin)
      return std::nullopt;
    if ((above > 0) != (below > 0)) continue;
    const double dx = to.x - from.x, dy = to.y - from.y;
    const auto side = [&, x = from.x](double at) { return (at - x) * dy - above * dx; };
    const double f = side(point.x);
    if (std::abs(f) <= margin * (std::abs(dx) + std::abs(dy))) return std::nullopt;
    if ((f > 0) == (side(other) > 0)) continue;
    const int from_left_to_right = dy > 0 ? -times : times;
    sum += point.x > other ? from_left_to_right : -from_left_to_right;
  }
  return sum;
}

}  // namespace fathom::fast
