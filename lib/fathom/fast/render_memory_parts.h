#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/render_memory.h"
#include "fathom/fast/tiles/tile.h"

namespace fathom {

namespace fast {

/// Tiles that threads take and give back.
class TileMemory {
 public:
  std::unique_ptr<Tile> take() {
    const std::lock_guard lock(mutex_);
    if (tiles_.empty()) return std::make_unique<Tile>();
    std::unique_ptr<Tile> tile = std::move(tiles_.back());
    tiles_.pop_back();
    return tile;
  }
  /// Where there is no memory for the list, the tile goes back to the system.
  void give_back(std::unique_ptr<Tile> tile) noexcept try {
    const std::lock_guard lock(mutex_);
    tiles_.push_back(std::move(tile));
  } catch (...) {
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Tile>> tiles_;
};

/// A tile of a thread, for one frame: the next one may be drawn by other threads.
class TakenTile {
 public:
  explicit TakenTile(TileMemory& memory) : memory_(memory), tile_(memory.take()) {}
  ~TakenTile() { memory_.give_back(std::move(tile_)); }
  TakenTile(const TakenTile&) = delete;
  TakenTile& operator=(const TakenTile&) = delete;

  [[nodiscard]] Tile& operator*() const { return *tile_; }

 private:
  TileMemory& memory_;
  std::unique_ptr<Tile> tile_;
};

}  // namespace fast

struct RenderMemory::Parts {
  fast::VertexMemory vertices;
  std::vector<fast::Bins> bins;
  fast::TileMemory tiles;
  /// Of the last camera with a lens.
  std::unique_ptr<const fast::Places> places;
};

}  // namespace fathom
