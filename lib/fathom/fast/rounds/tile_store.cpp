#include "fathom/fast/rounds/tile_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fathom/fast/rounds/packed_tile.h"
#include "fathom/threads/threads.h"

namespace fathom::fast {
namespace {

/// Where a tile waits: each has a place of its own, of which nothing is taken before it is written
/// to.
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
  slot.is_packed = false;
  if (slot.tile) return *slot.tile;
  slot.tile = std::make_unique_for_overwrite<Tile>();
  slot.tile->start(grid_.area(number));
  if (slot.waits) {
    restore([&](std::uint64_t offset,
                std::span<std::byte> bytes) { file_->read(place_of(number) + offset, bytes); },
            *slot.tile);
    slot.waits = false;
  }
  const std::lock_guard lock(mutex_);
  in_memory_.push_back(number);
  return *slot.tile;
}

// Tiles that were not taken since the last room was made are done with, or wait for longer: they
// are packed first. To pack the others takes less time than to write any, but in vain where writing
// cannot be helped.
void TileStore::make_room() {
  std::erase_if(in_memory_, [&](std::uint32_t number) { return !slots_[number].tile; });
  const auto is_old = [&](std::uint32_t number) { return slots_[number].used < rooms_made_; };
  const auto taken = std::stable_partition(in_memory_.begin(), in_memory_.end(), is_old);
  const auto old = static_cast<std::size_t>(taken - in_memory_.begin());
  bytes_ = 0;
  for (std::size_t i = 0; i < in_memory_.size(); ++i) {
    Slot& slot = slots_[in_memory_[i]];
    if (i >= old) slot.bytes = slot.tile->bytes();
    bytes_ += slot.bytes;
  }
  ++rooms_made_;
  pack(old);
  if (is_too_much() && most_when_packed() > most_kept()) write_oldest(old);
  pack(in_memory_.size());
  write_oldest(in_memory_.size());
}

std::uint64_t TileStore::most_when_packed() const {
  std::uint64_t bytes = 0;
  for (const std::uint32_t number : in_memory_)
    bytes += std::min(slots_[number].bytes, Tile::most_packed_bytes);
  return bytes;
}

void TileStore::pack(std::size_t end) {
  constexpr std::size_t some = 64;
  std::vector<std::uint32_t> unpacked;
  if (!is_too_much()) return;
  std::copy_if(in_memory_.begin(), in_memory_.begin() + static_cast<std::ptrdiff_t>(end),
               std::back_inserter(unpacked),
               [&](std::uint32_t number) { return !slots_[number].is_packed; });
  for (std::size_t from = 0; from < unpacked.size() && is_too_much(); from += some) {
    const std::size_t to = std::min(unpacked.size(), from + some);
    parallel_for(from, to, [&](std::size_t i) {
      Slot& slot = slots_[unpacked[i]];
      slot.tile->pack();
      slot.is_packed = true;
    });
    for (std::size_t i = from; i < to; ++i) {
      Slot& slot = slots_[unpacked[i]];
      bytes_ -= std::exchange(slot.bytes, slot.tile->bytes());
      bytes_ += slot.bytes;
    }
  }
}

// At most `count`, all of which have been packed.
void TileStore::write_oldest(std::size_t count) {
  if (!is_too_much()) return;
  if (!file_) file_.emplace();
  std::size_t end = 0;
  for (; end < count && is_too_much(); ++end) bytes_ -= slots_[in_memory_[end]].bytes;
  parallel_for(std::size_t{0}, end, [&](std::size_t i) {
    Slot& slot = slots_[in_memory_[i]];
    files::Bytes bytes;
    save(*slot.tile, bytes);
    file_->write(place_of(in_memory_[i]), bytes);
    slot.tile.reset();
    slot.waits = true;
  });
  in_memory_.erase(in_memory_.begin(), in_memory_.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace fathom::fast
