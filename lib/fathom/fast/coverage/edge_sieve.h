#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "fathom/fast/coverage/directed_edge.h"

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
    const std::uint64_t edge = word_of_edge(from, to), opposite = word_of_edge(to, from);
    std::uint64_t& slot = slots_[place_of_edge(from, to, shift_)];
    const std::uint64_t other = slot;
    const bool cancels = other == opposite;
    slot = cancels ? none : edge;
    left_[left_count_] = other;
    left_count_ += static_cast<std::size_t>(other != none && !cancels);
  }
  /// Calls visit(from, to) for each edge that is left: opposite ones may be among them.
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
  /// Those that had to leave: the first so many.
  std::vector<std::uint64_t> left_;
  std::size_t left_count_ = 0;
  int shift_ = 60;
};

}  // namespace fathom::fast
