#pragma once

#include <cstdint>
#include <vector>

namespace fathom {

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

  /// Empties it and makes room for so many edges.
  void start(std::size_t most_edges);
  /// Cancels an edge from `to` to `from`, or keeps this one until its opposite comes.
  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t edge = key(from, to), opposite = key(to, from);
    for (std::size_t i = start_of(from, to);; i = (i + 1) & mask_) {
      if (slots_[i] == opposite) {
        slots_[i] = cancelled;
        return;
      }
      if (slots_[i] == empty) {
        slots_[i] = edge;
        return;
      }
    }
  }
  /// visit(Edge) for each that is left.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    for (const std::uint64_t slot : slots_) {
      if (slot != empty && slot != cancelled) {
        visit(Edge{static_cast<std::uint32_t>(slot >> 32), static_cast<std::uint32_t>(slot)});
      }
    }
  }

 private:
  // No edge: its ends are equal.
  static constexpr std::uint64_t empty = 0, cancelled = 1ULL << 32 | 1;
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) {
    return std::uint64_t{from} << 32 | to;
  }
  [[nodiscard]] std::size_t start_of(std::uint32_t from, std::uint32_t to) const {
    // The same for both directions (Fibonacci hashing; Knuth, TAOCP 3, 6.4).
    const std::uint64_t sum = std::uint64_t{from} + to, product = std::uint64_t{from} * to;
    return static_cast<std::size_t>(((sum ^ product << 1) * 0x9E3779B97F4A7C15) >> shift_);
  }

  std::vector<std::uint64_t> slots_;
  std::size_t mask_ = 0;
  int shift_ = 63;
};

inline void EdgeBalance::start(std::size_t most_edges) {
  std::size_t size = 16;
  shift_ = 60;
  while (size < most_edges + most_edges / 2) {
    size *= 2;
    --shift_;
  }
  mask_ = size - 1;
  slots_.assign(size, empty);
}

}  // namespace fathom
