#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

// Directed edges of triangles; opposite edges cancel.
namespace fathom::fast {

// An edge as a single word, which is never 0 or 1; its vertices are less than 2³² − 1.
inline std::uint64_t word_of_edge(std::uint32_t from, std::uint32_t to) {
  return (std::uint64_t{from} + 1) << 32 | to;
}
inline std::uint32_t start_of_edge(std::uint64_t word) {
  return static_cast<std::uint32_t>((word >> 32) - 1);
}
inline std::uint32_t end_of_edge(std::uint64_t word) {
  return static_cast<std::uint32_t>(word);
}

/// The place of an edge, and of its opposite, in a table of 2^(64 − shift) places (Fibonacci
/// hashing, [Knu98] 6.4).
inline std::size_t place_of_edge(std::uint32_t from, std::uint32_t to, int shift) {
  const std::uint64_t sum = std::uint64_t{from} + to, product = std::uint64_t{from} * to;
  return static_cast<std::size_t>(((sum ^ product << 1) * 0x9E3779B97F4A7C15) >> shift);
}

/// Directed edges; opposite edges cancel.
///
/// Two triangles that are turned so that their areas are positive, and lie on different sides of a
/// common edge, run along it in opposite directions. So the number of triangles that cover a point
/// changes only across the edges that remain.
class EdgeBalance {
 public:
  struct Edge {
    std::uint32_t from, to;
    /// How many more times the edge was added than its opposite.
    std::uint32_t times = 1;
  };

  /// Removes all edges and makes room for about so many different edges; more are allowed.
  void start(std::size_t expected_edges);
  /// Adds an edge, which cancels an edge from `to` to `from` or is kept until such an edge is
  /// added. Vertices must be less than 2³² − 1.
  void add(std::uint32_t from, std::uint32_t to, std::uint32_t times = 1) {
    const std::uint64_t edge = word_of_edge(from, to), opposite = word_of_edge(to, from);
    for (std::size_t i = place_of_edge(from, to, shift_);; i = (i + 1) & mask_) {
      if (slots_[i] == opposite) {
        cancel(i, edge, times);
        return;
      }
      if (slots_[i] == edge) {
        add_more(i, times);
        return;
      }
      if (slots_[i] == empty) {
        slots_[i] = edge;
        if (times > 1) add_more(i, times - 1);
        if (++used_ > mask_ / 4 * 3) grow();
        return;
      }
    }
  }
  /// Calls visit(Edge) for each edge that remains.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i] > cancelled) visit(edge_in(i));
    }
  }

 private:
  // Less than any edge.
  static constexpr std::uint64_t empty = 0, cancelled = 1;
  [[nodiscard]] Edge edge_in(std::size_t i) const {
    return {start_of_edge(slots_[i]), end_of_edge(slots_[i]), 1 + (more_.empty() ? 0 : more_[i])};
  }
  void add_more(std::size_t i, std::uint32_t times) {
    if (more_.empty()) more_.resize(slots_.size());
    more_[i] += times;
  }
  /// Cancels the opposite of an edge, in slot i, `times` times.
  void cancel(std::size_t i, std::uint64_t edge, std::uint32_t times) {
    const std::uint32_t there = 1 + (more_.empty() ? 0 : more_[i]);
    if (!more_.empty()) more_[i] = 0;
    if (there == times) {
      slots_[i] = cancelled;
      return;
    }
    if (there < times) slots_[i] = edge;
    const std::uint32_t left = there < times ? times - there : there - times;
    if (left > 1) add_more(i, left - 1);
  }

  void grow();

  std::vector<std::uint64_t> slots_;
  /// How often the edge in each slot was added, less one; empty while this is 0 for all slots.
  std::vector<std::uint32_t> more_;
  /// Slots that are not empty.
  std::size_t used_ = 0;
  std::size_t mask_ = 0;
  int shift_ = 63;
};

inline void EdgeBalance::start(std::size_t expected_edges) {
  const std::size_t size = std::bit_ceil(std::max<std::size_t>(16, 2 * expected_edges));
  mask_ = size - 1;
  shift_ = std::countl_zero(mask_);
  used_ = 0;
  slots_.assign(size, empty);
  more_.clear();
}

inline void EdgeBalance::grow() {
  EdgeBalance before;
  before.slots_ = std::move(slots_);
  before.more_ = std::move(more_);
  start(before.slots_.size());
  before.for_each_left([&](const Edge& edge) { add(edge.from, edge.to, edge.times); });
}

/// Directed edges; most opposite edges cancel. A cheaper EdgeBalance: an edge has a single place in
/// the table and evicts any edge already there. If triangles come in the order of a surface, few
/// edges wait at any time, so few are evicted; and the code has no branches that a processor would
/// mispredict.
class EdgeSieve {
 public:
  /// Removes all edges and makes room for at most so many.
  void start(std::size_t most_edges) {
    const std::size_t size = std::bit_ceil(std::clamp<std::size_t>(most_edges / 4, 16, 4096));
    shift_ = std::countl_zero(size - 1);
    slots_.assign(size, none);
    if (left_.size() < most_edges) left_.resize(most_edges);
    left_count_ = 0;
  }
  /// Vertices must be less than 2³² − 1.
  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t edge = word_of_edge(from, to), opposite = word_of_edge(to, from);
    std::uint64_t& slot = slots_[place_of_edge(from, to, shift_)];
    const std::uint64_t other = slot;
    const bool cancels = other == opposite;
    slot = cancels ? none : edge;
    left_[left_count_] = other;
    left_count_ += static_cast<std::size_t>(other != none && !cancels);
  }
  /// Calls visit(from, to) for each edge that remains; some may be opposites of each other.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    const auto show = [&](std::uint64_t edge) { visit(start_of_edge(edge), end_of_edge(edge)); };
    std::for_each_n(left_.begin(), left_count_, show);
    for (const std::uint64_t slot : slots_) {
      if (slot != none) show(slot);
    }
  }

 private:
  static constexpr std::uint64_t none = 0;

  std::vector<std::uint64_t> slots_;
  /// The evicted edges: the first elements, as many as the following count.
  std::vector<std::uint64_t> left_;
  std::size_t left_count_ = 0;
  int shift_ = 60;
};

}  // namespace fathom::fast
