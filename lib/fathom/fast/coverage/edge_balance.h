#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace fathom::fast {

/// Directed edges of which opposite ones cancel.
///
/// Triangles turned so that their area is positive walk a common edge in opposite directions where
/// they lie on its two sides. How many triangles cover a point changes only across the edges that
/// are left.
class EdgeBalance {
 public:
  struct Edge {
    std::uint32_t from, to;
  };

  /// Empties it, with room for about so many different edges; there may be more.
  void start(std::size_t expected_edges);
  /// Of vertices less than 2³² − 1. Cancels an edge from `to` to `from`, or keeps this one until
  /// its opposite comes.
  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t edge = key(from, to), opposite = key(to, from);
    for (std::size_t i = start_of(from, to);; i = (i + 1) & mask_) {
      if (slots_[i] == opposite) {
        slots_[i] = cancelled;
        return;
      }
      if (slots_[i] == empty) {
        slots_[i] = edge;
        if (++used_ > mask_ / 4 * 3) grow();
        return;
      }
    }
  }
  /// visit(Edge) for each that is left.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    for (const std::uint64_t slot : slots_) {
      if (slot > cancelled) {
        visit(Edge{static_cast<std::uint32_t>((slot >> 32) - 1), static_cast<std::uint32_t>(slot)});
      }
    }
  }

 private:
  // Less than any edge.
  static constexpr std::uint64_t empty = 0, cancelled = 1;
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) {
    return (std::uint64_t{from} + 1) << 32 | to;
  }
  [[nodiscard]] std::size_t start_of(std::uint32_t from, std::uint32_t to) const {
    // The same for both directions (Fibonacci hashing; Knuth, TAOCP 3, 6.4).
    const std::uint64_t sum = std::uint64_t{from} + to, product = std::uint64_t{from} * to;
    return static_cast<std::size_t>(((sum ^ product << 1) * 0x9E3779B97F4A7C15) >> shift_);
  }

  void grow();

  std::vector<std::uint64_t> slots_;
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
}

inline void EdgeBalance::grow() {
  const std::vector<std::uint64_t> before = std::move(slots_);
  start(before.size());
  for (const std::uint64_t slot : before) {
    if (slot > cancelled)
      add(static_cast<std::uint32_t>((slot >> 32) - 1), static_cast<std::uint32_t>(slot));
  }
}

}  // namespace fathom::fast
