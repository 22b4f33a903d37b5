#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/boxes.h"
#include "fathom/fast/bins/nearness.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/vertices/vertex.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

/// The image cut into tiles, numbered row by row.
struct TileGrid {
  /// Fails    InputError if there are 2³² tiles or more, too many for the numbers in bins.
  TileGrid(std::uint32_t image_width, std::uint32_t image_height);
  [[nodiscard]] std::uint32_t count() const { return columns * rows; }
  [[nodiscard]] PixelBox area(std::uint32_t tile) const;
  /// The tile of a pixel.
  [[nodiscard]] std::uint32_t tile_at(std::uint32_t column, std::uint32_t row) const;
  /// Calls visit(number) for the tiles that an area meets.
  template <class Visit>
  void for_each_tile(const PixelBox& area, const Visit& visit) const {
    if (area.is_empty()) return;
    constexpr std::uint32_t size = TileShape::size;
    for (std::uint32_t row = area.first_row / size; row <= area.last_row / size; ++row)
      for (std::uint32_t k = area.first_column / size; k <= area.last_column / size; ++k)
        visit(row * columns + k);
  }

  std::uint32_t width, height;  // of the image
  std::uint32_t columns, rows;
};

/// Consecutive triangles of some objects and, for each tile, the triangles that can be visible in
/// it or that meet it.
class Bins {
 public:
  /// For the triangles first ≤ number < end of the objects.
  Bins(std::uint32_t first, std::uint32_t end) : first_(first), end_(end) {}
  /// For others; keeps the memory.
  void restart(std::uint32_t first, std::uint32_t end) {
    first_ = first;
    end_ = end;
  }

  struct Context {
    const ImageObjects& objects;
    const Camera& camera;
    Cull cull;
    /// Include all tiles that a triangle meets, not only tiles in which it can cover a sample.
    bool by_area;
    const TileGrid& grid;
    triangle::Referee& referee;
    RenderStatistics& statistics;
    /// Whether memory that is needed while sorting is kept for the next time.
    bool keep_memory = false;
  };
  void fill(const Context& context);

  /// The numbers of the triangles of a side (front, if the side takes exact numbers to find),
  /// grouped by object.
  [[nodiscard]] std::span<const TileEntry> in_tile(std::uint32_t tile, Side side) const {
    return lists_[index(side)].in_tile(tile);
  }
  [[nodiscard]] bool is_empty(std::uint32_t tile) const {
    return in_tile(tile, Side::front).empty() && in_tile(tile, Side::back).empty();
  }

 private:
  void add_object(const ImageObject& object, const Context& context);
  /// A triangle about which nothing is certain.
  void add_exactly(const ImageObject& object, std::uint32_t number, const Context& context);

  /// Triangles by tiles.
  class Lists {
   public:
    void start(std::uint32_t tiles);
    /// Triangles that meet one tile each.
    void add(const BoxBatch::Entries& entries);
    void add(std::uint32_t number, Nearness nearness, std::uint32_t tile) {
      entries_.push_back(std::uint64_t{tile} << 32 | number);
      nearness_.push_back(nearness);
      ++starts_[std::size_t{tile} + 1];
    }
    /// A triangle in all tiles that its box meets. `q`: moved_up_in_24_bits().
    void add(std::uint32_t number, std::uint32_t q, const PixelBox& box, const TileGrid& grid);
    void sort(bool keep_memory);
    [[nodiscard]] std::span<const TileEntry> in_tile(std::uint32_t tile) const {
      return std::span(sorted_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
    }

   private:
    /// Tile (upper half) and triangle (lower half).
    std::vector<std::uint64_t> entries_;
    std::vector<Nearness> nearness_;
    std::vector<TileEntry> sorted_;
    std::vector<std::size_t> starts_;
    std::vector<std::size_t> next_;
  };
  static std::size_t index(Side side) { return static_cast<std::size_t>(side); }

  std::uint32_t first_, end_;
  std::array<Lists, 2> lists_;
};

/// Whether any of these triangles may be visible in a tile, or meets it.
bool is_met(const std::vector<Bins>& bins, std::uint32_t tile);

}  // namespace fathom::fast
