// Rows of a tile to the map, past the caches.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/channels/map_rows.cpp"
#include "fathom/fast/channels/map_rows.h"

#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <variant>

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The size of a cache line, which the processor writes at once if it is written completely.
constexpr std::size_t line = 64;

void write_row(const std::byte* from, std::size_t bytes, std::byte* to) {
  const std::size_t into_line = reinterpret_cast<std::uintptr_t>(to) % line;
  const std::size_t head = into_line == 0 ? 0 : std::min(bytes, line - into_line);
  const std::size_t end = head + (bytes - head) / line * line;
  std::memcpy(to, from, head);
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
  std::memcpy(to + head, from + head, end - head);
#else
  const hn::CappedTag<std::uint8_t, line> d;
  for (std::size_t i = head; i < end; i += hn::Lanes(d)) {
    hn::Stream(hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(from + i)), d,
               reinterpret_cast<std::uint8_t*>(to + i));
  }
#endif
  std::memcpy(to + end, from + end, bytes - end);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {

HWY_EXPORT(write_row);

void MapRows::write_past_caches(const void* from, std::size_t bytes, void* to) {
  HWY_DYNAMIC_DISPATCH(write_row)
  (static_cast<const std::byte*>(from), bytes, static_cast<std::byte*>(to));
}

void MapRows::finish() const {
  if (past_caches) hwy::FlushStream();
}

BackgroundRows::BackgroundRows(const rendering::MapBackground& background, MapRows rows)
    : rows_(rows) {
  background.for_each([&]<class T>(T* values, T value) {
    Row<T> row;
    row.pixels.fill(value);
    row.values = values;
    channels_.emplace_back(row);
  });
}

void BackgroundRows::write(const PixelBox& part, const MapLayout& layout) const {
  const std::size_t columns = part.last_column - part.first_column + std::size_t{1};
  for (const AnyRow& channel : channels_) {
    std::visit(
        [&](const auto& row) {
          for (std::uint32_t y = part.first_row; y <= part.last_row; ++y) {
            rows_.write(row.pixels, columns, row.values + layout.pixel(part.first_column, y));
          }
        },
        channel);
  }
}

}  // namespace fathom::fast
#endif
