#include "fathom/fast/coverage/square_edges.h"

#include <algorithm>
#include <cmath>

#include "fathom/fast/coverage/area_bounds.h"
#include "fathom/fast/vertex.h"

namespace fathom::fast {

void SquareEdges::clear() {
  edges_.clear();
  level_.clear();
  extent_ = 1;
}

void SquareEdges::add(const SquarePoint& p, const SquarePoint& q, std::int32_t tag) {
  const SquarePoint& lower = p.y < q.y ? p : q;
  const SquarePoint& upper = p.y < q.y ? q : p;
  if (lower.y >= 1 || upper.y <= 0) return;
  if (upper.y - lower.y < 0x1p-60) {
    level_.push_back(std::max(lower.y, 0.0));
    level_.push_back(std::min(upper.y, 1.0));
    return;
  }
  extent_ = std::max({extent_, std::abs(p.x), std::abs(q.x)});
  Edge edge{};
  edge.x = lower.x;
  edge.y = lower.y;
  edge.slope = (upper.x - lower.x) / (upper.y - lower.y);
  edge.low = std::max(lower.y, 0.0);
  edge.high = std::min(upper.y, 1.0);
  edge.x_low = lower.y >= 0 ? lower.x : edge.at(0);
  edge.x_high = upper.y <= 1 ? upper.x : edge.at(1);
  edge.tag = tag;
  edges_.push_back(edge);
}

void SquareEdges::add_crossing(const Edge& a, const Edge& b) {
  const double low = std::max(a.low, b.low), high = std::min(a.high, b.high);
  if (!(low < high)) return;
  const double d_low = (low == a.low ? a.x_low : a.at(low)) - (low == b.low ? b.x_low : b.at(low));
  const double d_high =
      (high == a.high ? a.x_high : a.at(high)) - (high == b.high ? b.x_high : b.at(high));
  if ((d_low < 0) == (d_high < 0) || d_low == 0 || d_high == 0) return;
  breaks_.push_back(low + (high - low) * (d_low / (d_low - d_high)));
}

void SquareEdges::cut(bool tags_apart) {
  const Edge left{0, 0, 0, 0, 1, 0, 0, 0}, right{1, 0, 0, 0, 1, 1, 1, 0};
  breaks_.assign({0, 1});
  breaks_.insert(breaks_.end(), level_.begin(), level_.end());
  inside_.clear();
  for (const Edge& edge : edges_) {
    breaks_.push_back(edge.low);
    breaks_.push_back(edge.high);
    // Beyond a side all the way: equivalent to the side itself.
    if (std::max(edge.x_low, edge.x_high) <= 0 || std::min(edge.x_low, edge.x_high) >= 1) continue;
    add_crossing(edge, left);
    add_crossing(edge, right);
    for (const Edge* other : inside_) {
      if (!tags_apart || other->tag != edge.tag) add_crossing(edge, *other);
    }
    inside_.push_back(&edge);
  }
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

double SquareEdges::error_of(std::size_t crossings) const {
  const double xi = area_bounds::crossing_error * extent_;
  return 10 * static_cast<double>(crossings + 2) * xi +
         32 * unit_roundoff<double> * static_cast<double>(breaks_.size());
}

}  // namespace fathom::fast
