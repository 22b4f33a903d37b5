#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/nearness.h"

namespace fathom::fast {

class Tile;

/// The triangles of a tile that are worth drawing. One for each thread.
class VisibleTriangles {
 public:
  /// Room for the triangles of a tile, kept from one tile to the next.
  std::vector<TileEntry>& entries() { return entries_; }
  /// Calls draw(numbers) for the entries, in parts, without triangles that earlier parts certainly
  /// hide. Searching for hidden triangles, if `reject`, pays only if there are some: the first part
  /// and occasional later parts are searched, and the search continues while one in eight is
  /// hidden.
  template <class Draw>
  void for_each_part(Tile& tile, bool reject, const Draw& draw) {
    constexpr std::size_t least = 16, pause = 8;
    std::size_t parts_until_look = 0;
    std::span<const TileEntry> entries = entries_;
    for (; !entries.empty(); entries = entries.subspan(std::min(entries.size(), most_at_once))) {
      const auto some = entries.first(std::min(entries.size(), most_at_once));
      const bool look = reject && parts_until_look == 0 && some.size() >= least;
      const auto numbers = look ? visible_of(some, tile) : numbers_of(some);
      const bool pays = look && numbers.size() <= some.size() - some.size() / 8;
      parts_until_look = pays ? 0 : parts_until_look == 0 ? pause : parts_until_look - 1;
      if (!numbers.empty()) draw(numbers);
    }
  }

 private:
  static constexpr std::size_t most_at_once = 256;
  /// The numbers of the entries; the numbers of the triangles that may be visible.
  std::span<const std::uint32_t> numbers_of(std::span<const TileEntry> some);
  std::span<const std::uint32_t> visible_of(std::span<const TileEntry> some, Tile& tile);

  std::vector<TileEntry> entries_;
  /// Vectors may write beyond the last one.
  std::array<std::uint32_t, most_at_once + 16> numbers_;
};

}  // namespace fathom::fast
