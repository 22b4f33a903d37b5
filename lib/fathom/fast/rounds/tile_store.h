#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/spill_file.h"

// A packed tile as bytes, for a file.
namespace fathom::fast {

/// Where the samples of a tile lie: at the centres of its pixels, or anywhere in the window of a
/// lens.
enum class SamplesLie : std::uint8_t { at_pixels, anywhere };

/// Adds what the tile is to `bytes`, Tile::most_packed_bytes at most.
void save(const Tile& tile, SamplesLie samples, files::Bytes& bytes);

/// Makes a tile that was started where the saved one was the same as that: read(offset, to) reads
/// from its bytes.
using ReadSaved = std::function<void(std::uint64_t offset, std::span<std::byte> to)>;
void restore(const ReadSaved& read, SamplesLie samples, Tile& tile);

/// Tiles of an image that are drawn in rounds. Those that were not drawn into for the longest time
/// wait in a file where all together would take more memory than they may.
class TileStore {
 public:
  TileStore(const TileGrid& grid, std::uint64_t most_bytes,
            SamplesLie samples = SamplesLie::at_pixels)
      : grid_(grid), most_bytes_(most_bytes), samples_(samples), slots_(grid.count()) {}

  /// How many may be taken before make_room() is called again.
  [[nodiscard]] std::size_t most_at_once() const;
  /// A tile as it was left, or empty at first. Several threads may take different ones at the same
  /// time.
  /// Fails    InputError where the file cannot be read any more.
  Tile& take(std::uint32_t number);
  /// Whether it was taken before.
  [[nodiscard]] bool exists(std::uint32_t number) const {
    return slots_[number].tile || slots_[number].waits;
  }
  void forget(std::uint32_t number) { slots_[number] = {}; }
  /// Has the tiles in memory take less than they may. While no thread uses one.
  /// Fails    OutputError where the file cannot be written.
  void make_room();

 private:
  struct Slot {
    std::unique_ptr<Tile> tile;
    /// Rooms that were made before it was taken.
    std::uint64_t used = 0;
    /// What it took when a room was last made.
    std::size_t bytes = 0;
    bool is_packed = false, waits = false;
  };
  /// What is left for those that are not in use.
  [[nodiscard]] std::uint64_t most_kept() const { return most_bytes_ / 8 * 7; }
  [[nodiscard]] bool is_too_much() const { return bytes_ > most_kept(); }
  /// What all tiles in memory may take when they are packed.
  [[nodiscard]] std::uint64_t most_when_packed() const;
  /// As many as needed of the oldest, up to `end`.
  void pack(std::size_t end);
  void write_oldest(std::size_t count);

  const TileGrid& grid_;
  std::uint64_t most_bytes_;
  SamplesLie samples_;
  std::vector<Slot> slots_;
  /// Numbers of the tiles in memory, and what they take; when a room is made, the oldest comes
  /// first.
  std::vector<std::uint32_t> in_memory_;
  std::uint64_t bytes_ = 0;
  std::mutex mutex_;
  std::uint64_t rooms_made_ = 0;
  std::optional<files::SpillFile> file_;
};

}  // namespace fathom::fast
