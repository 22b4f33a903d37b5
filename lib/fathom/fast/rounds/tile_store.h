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

/// Appends the tile to `bytes`, at most Tile::most_packed_bytes.
void save(const Tile& tile, SamplesLie samples, files::Bytes& bytes);

/// Makes a tile that was started where the saved one was the same as that: read(offset, to) reads
/// from its bytes.
using ReadSaved = std::function<void(std::uint64_t offset, std::span<std::byte> to)>;
void restore(const ReadSaved& read, SamplesLie samples, Tile& tile);

/// Tiles of an image that are drawn in rounds. If they exceed their memory, the least recently used
/// tiles are stored in a file.
class TileStore {
 public:
  TileStore(const TileGrid& grid, std::uint64_t most_bytes,
            SamplesLie samples = SamplesLie::at_pixels)
      : grid_(grid), most_bytes_(most_bytes), samples_(samples), slots_(grid.count()) {}

  /// The number of tiles that may be taken before make_room() is called again.
  [[nodiscard]] std::size_t most_at_once() const;
  /// A tile in its previous state, initially empty. Several threads may take different tiles at the
  /// same time.
  /// Fails    InputError where the file cannot be read any more.
  Tile& take(std::uint32_t number);
  /// Whether it was taken before.
  [[nodiscard]] bool exists(std::uint32_t number) const {
    return slots_[number].tile || slots_[number].waits;
  }
  void forget(std::uint32_t number) { slots_[number] = {}; }
  /// Reduces the memory of the tiles below the limit. Call it while no thread uses a tile.
  /// Fails    OutputError where the file cannot be written.
  void make_room();

 private:
  struct Slot {
    std::unique_ptr<Tile> tile;
    /// The number of calls of make_room() before it was taken.
    std::uint64_t used = 0;
    /// Its size at the last make_room().
    std::size_t bytes = 0;
    bool is_packed = false, waits = false;
  };
  /// The memory for tiles that are not in use.
  [[nodiscard]] std::uint64_t most_kept() const { return most_bytes_ / 8 * 7; }
  [[nodiscard]] bool is_too_much() const { return bytes_ > most_kept(); }
  /// The limit on the memory of all packed tiles.
  [[nodiscard]] std::uint64_t most_when_packed() const;
  /// Packs as many of the oldest tiles as needed, up to `end`.
  void pack(std::size_t end);
  void write_oldest(std::size_t count);

  const TileGrid& grid_;
  std::uint64_t most_bytes_;
  SamplesLie samples_;
  std::vector<Slot> slots_;
  /// The numbers of the tiles in memory, and their size; in make_room(), the oldest comes first.
  std::vector<std::uint32_t> in_memory_;
  std::uint64_t bytes_ = 0;
  std::mutex mutex_;
  std::uint64_t rooms_made_ = 0;
  std::optional<files::SpillFile> file_;
};

}  // namespace fathom::fast
