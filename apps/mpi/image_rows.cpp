#include "apps/mpi/image_rows.h"

#include <algorithm>
#include <cstring>
#include <variant>

namespace fathom::app {
using namespace text;

namespace {

/// The values of a channel, whatever they are.
struct Plane {
  std::byte* values;
  std::size_t value_size;
};

Plane plane_of(ImageChannel& channel) {
  return std::visit(
      [](auto& values) {
        return Plane{reinterpret_cast<std::byte*>(values.data()), sizeof *values.data()};
      },
      channel.values);
}

/// Calls visit(its pixels, their bytes) for each row of a tile, from the top.
template <class Visit>
void for_each_row(const TilesAndRows& where, std::uint32_t tile, const Plane& plane,
                  const Visit& visit) {
  const std::uint32_t side = where.tiles.side;
  const std::uint32_t left = tile % where.tiles.columns * side;
  const std::uint32_t top = tile / where.tiles.columns * side;
  const std::uint32_t columns = std::min(side, where.width - left);
  const std::uint32_t rows = std::min(side, where.height - top);
  for (std::uint32_t row = top; row - top < rows; ++row) {
    visit(plane.values + (std::size_t{row} * where.width + left) * plane.value_size,
          columns * plane.value_size);
  }
}

}  // namespace

void send_rows(const Ranks& ranks, const TilesAndRows& where, DepthMap& map) {
  const std::uint32_t columns = where.tiles.columns;
  /// Calls visit(tile, the rank that it goes to) for the tiles that leave this rank, and visit(tile, the
  /// rank that it comes from) for those that come, in their order.
  const auto for_each_leaving = [&](const auto& visit) {
    for (std::uint32_t tile = 0; tile < where.of_tiles.size(); ++tile) {
      const int to = where.of_rows[tile / columns];
      if (where.of_tiles[tile] == ranks.self() && to != ranks.self()) visit(tile, to);
    }
  };
  const auto for_each_coming = [&](const auto& visit) {
    for (std::uint32_t tile = 0; tile < where.of_tiles.size(); ++tile) {
      const int from = where.of_tiles[tile];
      if (where.of_rows[tile / columns] == ranks.self() && from != ranks.self()) visit(tile, from);
    }
  };
  for (ImageChannel& channel : map.channels) {
    const Plane plane = plane_of(channel);
    std::vector<Bytes> messages(static_cast<std::size_t>(ranks.count()));
    for_each_leaving([&](std::uint32_t tile, int to) {
      for_each_row(where, tile, plane, [&](const std::byte* pixels, std::size_t bytes) {
        append(messages[static_cast<std::size_t>(to)], ByteView(pixels, bytes));
      });
    });
    messages = ranks.exchange(std::move(messages));
    std::vector<std::size_t> next(messages.size(), 0);
    for_each_coming([&](std::uint32_t tile, int from) {
      const auto rank = static_cast<std::size_t>(from);
      for_each_row(where, tile, plane, [&](std::byte* pixels, std::size_t bytes) {
        std::memcpy(pixels, &messages[rank].at(next[rank]), bytes);
        next[rank] += bytes;
      });
    });
  }
}

}  // namespace fathom::app
