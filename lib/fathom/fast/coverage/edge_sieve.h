#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace fathom::fast {

/// Directed edges, of which most opposite ones cancel: what EdgeBalance does, without its care. An
/// edge has one place, without regard to what is there, and an edge that was there has to leave.
/// Where triangles come in the order of a surface, few edges wait at any time, so that few have to;
/// and nothing is asked that a processor would have to guess.
class EdgeSieve {
 public:
  /// Empties it, for so many edges at most.
  void start(std::size_t most_edges) {
    const std::size_t size = std::bit_ceil(std::clamp<std::size_t>(most_edges / 4, 16, 4096));
    shift_ = std::countl_zero(size - 1);
    slots_.assign(size, none);
    if (left_.size() < most_edges) left_.resize(most_edges);
    left_count_ = 0;
  }
  /// Vertices must be less than 2³² − 1.
  void add(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t edge = key(from, to), opposite = key(to, from);
    std::uint64_t& slot = slots_[place_of(from, to)];
    const std::uint64_t other = slot;
    const bool cancels = other == opposite;
    slot = cancels ? none : edge;
    left_[left_count_] = other;
    left_count_ += static_cast<std::size_t>(other != none && !cancels);
  }
  /// Calls visit(from, to) for each edge that is left: opposite ones may be among them.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    const auto show = [&](std::uint64_t edge) {
      visit(static_cast<std::uint32_t>((edge >> 32) - 1), static_cast<std::uint32_t>(edge));
    };
    std::for_each_n(left_.begin(), left_count_, show);
    for (const std::uint64_t slot : slots_) {
      if (slot != none) show(slot);
    }
  }

 private:
  static constexpr std::uint64_t none = 0;
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) {
    return (std::uint64_t{from} + 1) << 32 | to;
  }
  /// The same for both directions (Fibonacci hashing, [Knu98] 6.4).
  [[nodiscard]] std::size_t place_of(std::uint32_t from, std::uint32_t to) const {
    const std::uint64_t sum = std::uint64_t{from} + to, product = std::uint64_t{from} * to;
    return static_cast<std::size_t>(((sum ^ product << 1) * 0x9E3779B97F4A7C15) >> shift_);
  }

  std::vector<std::uint64_t> slots_;
  /// Those that had to leave: the first so many.
  std::vector<std::uint64_t> left_;
  std::size_t left_count_ = 0;
  int shift_ = 60;
};

}  // namespace fathom::fast
