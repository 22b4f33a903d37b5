#include "fathom/fast/coverage/square_edges.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::fast {
namespace {

/// Sorts numbers, or nearly sorted items; calls visit(a, b) for each two that change places, where
/// a was before b.
template <class Items, class Key, class Visit>
void sort_by(Items& items, const Key& key, const Visit& visit) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    if (!(key(items[i]) < key(items[i - 1]))) continue;
    const auto item = items[i];
    std::size_t place = i;
    for (; place > 0 && key(item) < key(items[place - 1]); --place) {
      visit(items[place - 1], item);
      items[place] = items[place - 1];
    }
    items[place] = item;
  }
}

template <class Items, class Key>
void sort_by(Items& items, const Key& key) {
  sort_by(items, key, [](const auto&, const auto&) {});
}

}  // namespace

void SquareEdges::clear() {
  edges_.clear();
  level_.clear();
  extent_ = 1;
}

// An edge that is level, or nearly, passes x = 0 where it is, at once; its end at q counts as the
// upper one if they have the same height.
void SquareEdges::add(const SquarePoint& p, const SquarePoint& q, std::int32_t tag) {
  const SquarePoint& lower = p.y < q.y ? p : q;
  const SquarePoint& upper = p.y < q.y ? q : p;
  if (lower.y >= 1 || upper.y <= 0) return;
  if (upper.y - lower.y < 0x1p-60) {
    const std::int32_t passed = (upper.x < 0 ? tag : 0) - (lower.x < 0 ? tag : 0);
    level_.push_back({std::max(lower.y, 0.0), std::min(upper.y, 1.0), passed});
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
  // Beyond the right side all the way it bounds no length in the square, and never passes x = 0.
  if (std::min(edge.x_low, edge.x_high) >= 1) return;
  edges_.push_back(edge);
}

void SquareEdges::start() {
  passed_ = 0;
  slabs_ = next_edge_ = next_level_ = 0;
  in_u_ = 32 * static_cast<double>(level_.size());
  in_xi_ = 0;
  crossings_.clear();
  waiting_.clear();
  breaks_.assign({0, 1});
  for (const Edge& edge : edges_) {
    waiting_.push_back(&edge);
    if (edge.low > 0) breaks_.push_back(edge.low);
    if (edge.high < 1) breaks_.push_back(edge.high);
  }
  for (const Level& level : level_) breaks_.insert(breaks_.end(), {level.low, level.high});
  std::sort(waiting_.begin(), waiting_.end(),
            [](const Edge* a, const Edge* b) { return a->low < b->low; });
  std::sort(level_.begin(), level_.end(),
            [](const Level& a, const Level& b) { return a.low < b.low; });
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

/// Moves to the heights between two breaks: removes the edges that end and adds the edges that
/// begin.
void SquareEdges::enter(double low, double high) {
  std::size_t kept = 0;
  for (Crossing& crossing : crossings_) {
    const Edge& edge = *crossing.edge;
    if (edge.high <= low) {
      look_at_side(crossing, edge.x_high < 0);
      continue;
    }
    crossing.x_low = crossing.x_high;
    crossings_[kept++] = crossing;
  }
  crossings_.resize(kept);
  for (; next_level_ < level_.size() && level_[next_level_].low <= low; ++next_level_) {
    passed_ += level_[next_level_].passed;
  }
  for (; next_edge_ < waiting_.size() && waiting_[next_edge_]->low <= low; ++next_edge_) {
    const Edge& edge = *waiting_[next_edge_];
    crossings_.push_back({edge.x_low, edge.tag, edge.x_low < 0, &edge, edge.x_low, 0});
  }
  for (Crossing& crossing : crossings_) {
    const Edge& edge = *crossing.edge;
    crossing.x_high = edge.high == high ? edge.x_high : edge.at(high);
  }
}

// Item 4.
bool SquareEdges::is_beyond_a_side(const Crossing& c) const {
  const double margin = 4 * crossing_error();
  return std::max(c.x_low, c.x_high) < -margin || std::min(c.x_low, c.x_high) > 1 + margin;
}

// On the way from x = 0 at the upper end to any point of the strip, each edge is passed at most
// once.
SquareEdges::Strip SquareEdges::strip(double thickness) const {
  Strip strip{thickness, passed_, 0, 0};
  for (const Crossing& c : crossings_) {
    if (is_beyond_a_side(c)) continue;
    const std::int32_t change = c.is_left ? -c.tag : c.tag;
    strip.least += std::min(change, 0);
    strip.greatest += std::max(change, 0);
  }
  return strip;
}

/// To the lower end of a strip.
void SquareEdges::leave_undivided() {
  ++slabs_;
  for (Crossing& crossing : crossings_) look_at_side(crossing, crossing.x_high < 0);
}

void SquareEdges::add_cut(double low, double high, double d_low, double d_high) {
  if ((d_low < 0) == (d_high < 0) || d_low == 0 || d_high == 0) return;
  cuts_.push_back(low + (high - low) * (d_low / (d_low - d_high)));
}

// Two crossings change places exactly once while crossings that are sorted by x at one height are
// sorted by x at another. If they do so beyond a side of the square, this bounds no length in it.
void SquareEdges::find_cuts(double low, double high) {
  cuts_.clear();
  for (const Crossing& c : crossings_) {
    add_cut(low, high, c.x_low, c.x_high);
    add_cut(low, high, c.x_low - 1, c.x_high - 1);
  }
  sort_by(crossings_, [](const Crossing& c) { return c.x_low; });
  const auto cross = [&](const Crossing& a, const Crossing& b) {
    const bool is_left = std::max({a.x_low, a.x_high, b.x_low, b.x_high}) <= 0;
    const bool is_right = std::min({a.x_low, a.x_high, b.x_low, b.x_high}) >= 1;
    if (!is_left && !is_right) add_cut(low, high, a.x_low - b.x_low, a.x_high - b.x_high);
  };
  sort_by(
      crossings_, [](const Crossing& c) { return c.x_high; }, cross);
  std::sort(cuts_.begin(), cuts_.end());
}

void SquareEdges::move_to(double height) {
  for (Crossing& crossing : crossings_) {
    crossing.x = crossing.edge->at(height);
    look_at_side(crossing, crossing.x < 0);
  }
  sort_by(crossings_, [](const Crossing& c) { return c.x; });
}

void SquareEdges::add_errors(double heights) {
  const std::size_t slabs = 1 + cuts_.size();
  std::size_t met = 0;
  bool has_slope_bound = false;
  for (const Crossing& c : crossings_) {
    if (is_beyond_a_side(c)) continue;
    ++met;
    has_slope_bound = std::abs(c.edge->slope) <= 0x1p20;
  }
  slabs_ += slabs;
  if (met == 0) return;
  const bool alone = met == 1 && has_slope_bound;
  in_u_ += (alone ? 1 : 32) * static_cast<double>(slabs);
  in_xi_ += (alone ? 6 : 10 * static_cast<double>(met + 2)) * heights;
}

double SquareEdges::error(double sum) const {
  return in_xi_ * crossing_error() +
         unit_roundoff<double> * (in_u_ + 4 * static_cast<double>(slabs_ + 2) * sum);
}

double SquareEdges::crossing_error() const {
  return area_bounds::crossing_error * extent_;
}

}  // namespace fathom::fast
