#include "apps/mpi/image_rows.h"

#include <algorithm>
#include <cstring>
#include <variant>

#include "apps/mpi/tile_rows.h"

namespace fathom::app {
using namespace text;

namespace {

/// The values of a channel, whatever they are, of an image or of a band that begins with this row.
struct Plane {
  std::byte* values;
  std::size_t value_size;
  std::uint32_t first_row = 0;
};

Plane plane_of(ImageChannel& channel, std::uint32_t first_row) {
  return std::visit(
      [&](auto& values) {
        return Plane{reinterpret_cast<std::byte*>(values.data()), sizeof *values.data(), first_row};
      },
      channel.values);
}

ImageChannel channel_like(const ImageChannel& other, std::size_t pixels) {
  return std::visit(
      [&]<class T>(const Samples<T>&) {
        return ImageChannel{other.name, Samples<T>(pixels)};
      },
      other.values);
}

/// Calls visit(where its pixels are, how many bytes they take) for each row of a tile, from the top.
template <class Visit>
void for_each_row(const TilesAndRows& where, std::uint32_t tile, const Plane& plane,
                  const Visit& visit) {
  const auto visit_row = [&](std::uint32_t row, std::uint32_t left, std::uint32_t columns) {
    const std::size_t pixel = std::size_t{row - plane.first_row} * where.width + left;
    visit(plane.values + pixel * plane.value_size, columns * plane.value_size);
  };
  for_each_row_of_tile(where.tiles, tile, where.width, where.height, visit_row);
}

/// The rows of pixels first ≤ row < end.
struct Band {
  std::uint32_t first = 0, end = 0;
};

Band band_of(const TilesAndRows& where, int rank) {
  const auto [first, end] = std::equal_range(where.of_rows.begin(), where.of_rows.end(), rank);
  const auto row_at = [&](auto tile_row) {
    const auto rows = static_cast<std::uint32_t>(tile_row - where.of_rows.begin());
    return rows == where.tiles.rows ? where.height : rows * where.tiles.side;
  };
  return {row_at(first), row_at(end)};
}

/// From the channel that this rank has drawn to that of its band.
void move_channel(const Ranks& ranks, const TilesAndRows& where, const Plane& drawn,
                  const Plane& band, Traffic& traffic) {
  std::vector<Bytes> messages(static_cast<std::size_t>(ranks.count()));
  // What stays goes the same way, to itself.
  for (std::uint32_t tile = 0; tile < where.of_tiles.size(); ++tile) {
    if (where.of_tiles[tile] != ranks.self()) continue;
    const auto to = static_cast<std::size_t>(where.of_rows[tile / where.tiles.columns]);
    for_each_row(where, tile, drawn, [&](const std::byte* pixels, std::size_t bytes) {
      append(messages[to], ByteView(pixels, bytes));
    });
  }
  traffic.add(messages, ranks.self());
  messages = ranks.exchange(std::move(messages));
  std::vector<std::size_t> next(messages.size(), 0);
  for (std::uint32_t tile = 0; tile < where.of_tiles.size(); ++tile) {
    if (where.of_rows[tile / where.tiles.columns] != ranks.self()) continue;
    const auto from = static_cast<std::size_t>(where.of_tiles[tile]);
    for_each_row(where, tile, band, [&](std::byte* pixels, std::size_t bytes) {
      std::memcpy(pixels, &messages[from].at(next[from]), bytes);
      next[from] += bytes;
    });
  }
}

}  // namespace

std::vector<int> equal_bands(std::uint32_t rows, int ranks) {
  std::vector<int> owners(rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    owners[row] = static_cast<int>(std::uint64_t{row} * static_cast<std::uint64_t>(ranks) / rows);
  }
  return owners;
}

DepthMap with_own_rows(const Ranks& ranks, const TilesAndRows& where, DepthMap drawn,
                       Traffic& traffic) {
  if (ranks.count() == 1) return drawn;
  const Band rows = band_of(where, ranks.self());
  std::vector<ImageChannel> channels = std::move(drawn.channels);
  DepthMap band = std::move(drawn);
  band.height = rows.end - rows.first;
  band.channels.clear();
  for (ImageChannel& channel : channels) {
    band.channels.push_back(channel_like(channel, std::size_t{band.width} * band.height));
    move_channel(ranks, where, plane_of(channel, 0), plane_of(band.channels.back(), rows.first),
                 traffic);
    channel = {};  // its memory goes back
  }
  return band;
}

}  // namespace fathom::app
