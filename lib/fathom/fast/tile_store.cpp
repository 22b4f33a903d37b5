#include "fathom/fast/tile_store.h"

#include <algorithm>

#include "fathom/threads/threads.h"

namespace fathom::fast {
namespace {

/// Where a tile waits: each has a place of its own, of which nothing is taken before it is written to.
std::uint64_t place_of(std::uint32_t number) {
  return std::uint64_t{number} * Tile::most_packed_bytes;
}

}  // namespace

std::size_t TileStore::most_at_once() const {
  return static_cast<std::size_t>(
      std::max<std::uint64_t>(1, most_bytes_ / 8 / Tile::most_packed_bytes));
}

Tile& TileStore::take(std::uint32_t number) {
  Slot& slot = slots_[number];
  slot.used = rooms_made_;
  if (slot.tile) return *slot.tile;
  slot.tile = std::make_unique_for_overwrite<Tile>();
  slot.tile->start(grid_.area(number));
  if (slot.waits) {
    slot.tile->restore([&](std::uint64_t offset, std::span<std::byte> bytes) {
      file_->read(place_of(number) + offset, bytes);
    });
    slot.waits = false;
  }
  const std::lock_guard lock(mutex_);
  in_memory_.push_back(number);
  return *slot.tile;
}

void TileStore::make_room() {
  ++rooms_made_;
  std::erase_if(in_memory_, [&](std::uint32_t number) { return !slots_[number].tile; });
  std::uint64_t bytes = 0;
  for (const std::uint32_t number : in_memory_) bytes += slots_[number].tile->bytes();
  if (bytes <= most_kept()) return;
  std::ranges::sort(in_memory_, {}, [&](std::uint32_t number) { return slots_[number].used; });
  pack_oldest(bytes);
  if (bytes <= most_kept()) return;
  if (!file_) file_.emplace();
  std::size_t count = 0;
  for (; bytes > most_kept(); ++count) bytes -= slots_[in_memory_[count]].tile->bytes();
  parallel_for(std::size_t{0}, count, [&](std::size_t i) { write(in_memory_[i]); });
  in_memory_.erase(in_memory_.begin(), in_memory_.begin() + static_cast<std::ptrdiff_t>(count));
}

void TileStore::pack_oldest(std::uint64_t& bytes) {
  constexpr std::size_t some = 64;
  for (std::size_t first = 0; first < in_memory_.size() && bytes > most_kept(); first += some) {
    const std::size_t end = std::min(in_memory_.size(), first + some);
    for (std::size_t i = first; i < end; ++i) bytes -= slots_[in_memory_[i]].tile->bytes();
    parallel_for(first, end, [&](std::size_t i) { slots_[in_memory_[i]].tile->pack(); });
    for (std::size_t i = first; i < end; ++i) bytes += slots_[in_memory_[i]].tile->bytes();
  }
}

void TileStore::write(std::uint32_t number) {
  Slot& slot = slots_[number];
  text::Bytes bytes;
  slot.tile->save(bytes);
  file_->write(place_of(number), bytes);
  slot.tile.reset();
  slot.waits = true;
}

}  // namespace fathom::fast
