#include "apps/mpi/image_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>
#include <variant>

#include "apps/shell/standard_streams.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {

using namespace files;

namespace {

/// The values of a channel, whatever they are, as bytes.
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

ImageChannel channel_like(const ImageChannel& other, std::size_t pixels) {
  return std::visit(
      [&]<class T>(const Samples<T>&) {
        return ImageChannel{other.name, Samples<T>(pixels)};
      },
      other.values);
}

/// Calls visit(row, left, columns) for each row of pixels of a tile, from the top, in an image of
/// width × height pixels: `columns` of them from `left` on.
template <class Visit>
void for_each_row_of_tile(const ImageTiles& tiles, std::uint32_t tile, std::uint32_t width,
                          std::uint32_t height, const Visit& visit) {
  const std::uint32_t left = tile % tiles.columns * tiles.side;
  const std::uint32_t top = tile / tiles.columns * tiles.side;
  const std::uint32_t columns = std::min(tiles.side, width - left);
  const std::uint32_t rows = std::min(tiles.side, height - top);
  for (std::uint32_t row = top; row - top < rows; ++row) visit(row, left, columns);
}

/// Calls visit(where its pixels are, how many bytes they take) for each row of each channel of a
/// tile, in a map that has rows of tiles from `first_row` on.
template <class Visit>
void for_each_row_of_pixels(const DrawnTiles& where, std::uint32_t tile, std::uint32_t first_row,
                            DepthMap& map, const Visit& visit) {
  for (ImageChannel& channel : map.channels) {
    const Plane plane = plane_of(channel);
    const auto visit_row = [&](std::uint32_t row, std::uint32_t left, std::uint32_t columns) {
      const std::size_t pixel =
          std::size_t{row - first_row * where.tiles.side} * where.width + left;
      visit(plane.values + pixel * plane.value_size, columns * plane.value_size);
    };
    for_each_row_of_tile(where.tiles, tile, where.width, where.height, visit_row);
  }
}

/// Calls visit(tile) for tiles of these rows, in ascending order.
template <class Visit>
void for_each_tile(const DrawnTiles& where, const TileRows& rows, const Visit& visit) {
  const std::uint32_t columns = where.tiles.columns;
  for (std::uint32_t tile = rows.first * columns; tile < rows.end * columns; ++tile) visit(tile);
}

bool has_drawn_any(const DrawnTiles& where, const TileRows& rows, int rank) {
  bool any = false;
  for_each_tile(where, rows, [&](std::uint32_t tile) { any |= where.of_tiles[tile] == rank; });
  return any;
}

}  // namespace

std::vector<TileRows> equal_bands(std::uint32_t rows, int ranks) {
  const auto first_of = [&](int rank) {
    const std::uint64_t share = std::uint64_t{rows} * static_cast<std::uint64_t>(rank);
    const auto count = static_cast<std::uint64_t>(ranks);
    return static_cast<std::uint32_t>((share + count - 1) / count);
  };
  std::vector<TileRows> bands;
  bands.reserve(static_cast<std::size_t>(ranks));
  for (int rank = 0; rank < ranks; ++rank) bands.push_back({first_of(rank), first_of(rank + 1)});
  return bands;
}

std::vector<TileRows> all_for_first(std::uint32_t rows, int ranks) {
  std::vector<TileRows> bands(static_cast<std::size_t>(ranks), {rows, rows});
  bands.front() = {0, rows};
  return bands;
}

std::vector<TileRows> parts_of(std::span<const TileRows> bands, std::uint32_t from,
                               std::uint32_t most) {
  std::vector<TileRows> parts;
  for (const TileRows& band : bands) {
    const std::uint32_t first = band.first + std::min(from, band.count());
    parts.push_back({first, first + std::min(most, band.end - first)});
  }
  return parts;
}

std::vector<Bytes> pixels_for_others(const Ranks& ranks, const DrawnTiles& where,
                                     std::span<const TileRows> of_ranks, const RowsDrawn& drawn) {
  std::vector<Bytes> messages(of_ranks.size());
  for (std::size_t to = 0; to < of_ranks.size(); ++to) {
    const TileRows& rows = of_ranks[to];
    if (static_cast<int>(to) == ranks.self() || !has_drawn_any(where, rows, ranks.self())) continue;
    DepthMap map = drawn(rows);
    for_each_tile(where, rows, [&](std::uint32_t tile) {
      if (where.of_tiles[tile] != ranks.self()) return;
      for_each_row_of_pixels(where, tile, rows.first, map,
                             [&](const std::byte* pixels, std::size_t bytes) {
                               append(messages[to], ByteView(pixels, bytes));
                             });
    });
  }
  return messages;
}

DepthMap rows_from_all(const Ranks& ranks, const DrawnTiles& where, const TileRows& own,
                       const RowsDrawn& drawn, const std::vector<Bytes>& from_others) {
  if (own.count() == 0) return {};
  DepthMap map = drawn(own);
  std::vector<std::size_t> next(from_others.size(), 0);
  for_each_tile(where, own, [&](std::uint32_t tile) {
    const auto from = static_cast<std::size_t>(where.of_tiles[tile]);
    if (static_cast<int>(from) == ranks.self()) return;
    for_each_row_of_pixels(where, tile, own.first, map, [&](std::byte* pixels, std::size_t bytes) {
      std::memcpy(pixels, &from_others[from].at(next[from]), bytes);
      next[from] += bytes;
    });
  });
  return map;
}

WholeMap::WholeMap(DepthMap first_rows, std::uint32_t height) : map_(std::move(first_rows)) {
  const std::vector<ImageChannel> channels = std::exchange(map_.channels, {});
  map_.height = height;
  for (const ImageChannel& channel : channels)
    map_.channels.push_back(channel_like(channel, std::size_t{map_.width} * height));
  add(channels);
}

void WholeMap::add(const std::vector<ImageChannel>& rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::visit(
        [&]<class T>(Samples<T>& values) {
          const auto& more = std::get<Samples<T>>(rows[i].values);
          std::ranges::copy(more, values.begin() + static_cast<std::ptrdiff_t>(pixels_));
          count = more.size();
        },
        map_.channels[i].values);
  }
  pixels_ += count;
}

using namespace files;

RowShare share_of(const Ranks& ranks) {
  return {static_cast<std::uint32_t>(ranks.self()), static_cast<std::uint32_t>(ranks.count())};
}

RowsOfOthers::RowsOfOthers(const Ranks& ranks)
    : counts_(static_cast<std::size_t>(ranks.count())), items_(counts_.size()) {
  for (int rank = 1; rank < ranks.count(); ++rank) {
    counts_[static_cast<std::size_t>(rank)].bytes = ranks.receive_from(rank);
    items_[static_cast<std::size_t>(rank)].bytes = ranks.receive_from(rank);
  }
}

void send_rows(const Ranks& ranks, std::uint32_t width, std::span<const std::uint32_t> counts,
               ByteView items, Traffic& traffic) {
  const RowShare share = share_of(ranks);
  std::vector<std::uint32_t> of_share;
  for (std::size_t row = 0; row * width < counts.size(); ++row) {
    if (!share.has_row(static_cast<std::uint32_t>(row))) continue;
    const auto of_row = counts.subspan(row * width, width);
    of_share.insert(of_share.end(), of_row.begin(), of_row.end());
  }
  for (const ByteView message : {std::as_bytes(std::span(of_share)), items}) {
    ranks.send_to_first(message);
    traffic.add(message.size());
  }
}

namespace {

/// Writes an EXR from its beginning to its end; at last, the table of where its chunks are.
class ExrFile {
 public:
  ExrFile(const std::filesystem::path& path, const Bytes& beginning, std::size_t chunks)
      : path_(path),
        file_(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)),
        table_(chunks * sizeof(std::uint64_t)),
        table_at_(beginning.size() - table_.size()) {
    if (!file_.is_open()) fail_with_errno(path_, errno);
    write(beginning);
  }

  void add(std::uint32_t first_row, ByteView chunk) {
    store<std::uint64_t>(&table_[next_++ * sizeof(std::uint64_t)], size_, std::endian::little);
    Bytes head(2 * sizeof(std::uint32_t));
    store(&head[0], first_row, std::endian::little);
    store(&head[sizeof first_row], static_cast<std::uint32_t>(chunk.size()), std::endian::little);
    write(head);
    write(chunk);
  }

  void finish() {
    if (::lseek(file_.get(), static_cast<off_t>(table_at_), SEEK_SET) < 0)
      fail_with_errno(path_, errno);
    write(table_);
    if (!file_.close()) fail_with_errno(path_, errno);
  }

 private:
  void write(ByteView bytes) {
    write_all(file_.get(), reinterpret_cast<const char*>(bytes.data()), bytes.size(), path_);
    size_ += bytes.size();
  }

  std::filesystem::path path_;
  Descriptor file_;
  Bytes table_;
  std::size_t table_at_;
  std::size_t next_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace

void WaitingChunks::add(files::Bytes chunk) {
  const std::uint64_t size = chunk.size();
  bytes_ += size;
  if (bytes_ <= most_bytes_) {
    chunks_.push_back({std::move(chunk), 0, 0});
    return;
  }
  if (!file_) file_.emplace();
  chunks_.push_back({{}, file_->append(chunk), size});
}

files::Bytes WaitingChunks::take() {
  Chunk& chunk = chunks_.at(next_++);
  if (chunk.size == 0) return std::exchange(chunk.bytes, {});
  files::Bytes bytes(chunk.size);
  file_->read(chunk.offset, bytes);
  return bytes;
}

void write_banded_exr(const Ranks& ranks, const std::filesystem::path& path, const Bytes& beginning,
                      std::span<const int> of_chunks, std::uint32_t rows_of_chunk,
                      WaitingChunks& own_chunks) {
  std::exception_ptr failure;
  const auto unless_failed = [&](const auto& work) {
    if (failure) return;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  std::optional<ExrFile> file;
  if (ranks.is_first()) unless_failed([&] { file.emplace(path, beginning, of_chunks.size()); });
  for (std::size_t i = 0; i < of_chunks.size(); ++i) {
    Bytes chunk;
    const bool is_own = of_chunks[i] == ranks.self();
    if (is_own) unless_failed([&] { chunk = own_chunks.take(); });
    if (!ranks.is_first()) {
      if (is_own) ranks.send_to_first(chunk);
      continue;
    }
    if (!is_own) chunk = ranks.receive_from(of_chunks[i]);
    unless_failed([&] { file->add(static_cast<std::uint32_t>(i) * rows_of_chunk, chunk); });
  }
  if (file) unless_failed([&] { file->finish(); });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fathom::app
