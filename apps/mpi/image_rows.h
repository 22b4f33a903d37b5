#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/traffic.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/spill_file.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"
#include "fathom/image/row_share.h"

/// Rows of an image as messages between ranks: pixels of tiles that they have drawn, and items that
/// each rank has found in its share of the rows.
namespace fathom::app {

/// Rows first ≤ row < end of tiles.
struct TileRows {
  std::uint32_t first = 0, end = 0;
  [[nodiscard]] std::uint32_t count() const { return end - first; }
};

/// Divides rows of tiles into bands of about equal height, the first for rank 0. Some ranks may get
/// no row.
std::vector<TileRows> equal_bands(std::uint32_t rows, int ranks);
/// All of them for rank 0.
std::vector<TileRows> all_for_first(std::uint32_t rows, int ranks);

/// The parts of the ranks' bands that begin at row `from` of the band and have at most `most` rows.
std::vector<TileRows> parts_of(std::span<const TileRows> bands, std::uint32_t from,
                               std::uint32_t most);

/// The rank that has drawn each tile of an image.
struct DrawnTiles {
  ImageTiles tiles;
  std::uint32_t width = 0, height = 0;
  std::span<const int> of_tiles;
};

/// Makes the map of rows of tiles with values where this rank has drawn.
using RowsDrawn = std::function<DepthMap(const TileRows&)>;

/// Messages to the other ranks, one for each: the pixels that this rank has drawn of the rows that
/// the receiver compresses.
/// Fails    as `drawn` does.
std::vector<files::Bytes> pixels_for_others(const Ranks& ranks, const DrawnTiles& where,
                                            std::span<const TileRows> of_ranks,
                                            const RowsDrawn& drawn);
/// The map of this rank's rows, from pixels that it has drawn and pixels received from other ranks.
DepthMap rows_from_all(const Ranks& ranks, const DrawnTiles& where, const TileRows& own,
                       const RowsDrawn& drawn, const std::vector<files::Bytes>& from_others);

/// A map that is put together from rows, one after another.
class WholeMap {
 public:
  /// For an image of this height, with its first rows.
  WholeMap(DepthMap first_rows, std::uint32_t height);
  /// Appends the next rows; the same channels.
  void add(const std::vector<ImageChannel>& rows);
  [[nodiscard]] DepthMap take() { return std::move(map_); }

 private:
  DepthMap map_;
  std::size_t pixels_ = 0;
};

/// The rows of an image that a rank makes by itself, when each rank has the whole scene.
RowShare share_of(const Ranks& ranks);

/// In the first rank, the items that other ranks have found in their shares of the rows.
class RowsOfOthers {
 public:
  explicit RowsOfOthers(const Ranks& ranks);
  /// Takes the next counts, or the next items, of a rank.
  void take_counts(std::size_t rank, std::span<std::uint32_t> to) { take(counts_[rank], to); }
  template <class Item>
  void take_items(std::size_t rank, std::span<Item> to) {
    take(items_[rank], to);
  }

 private:
  struct List {
    files::Bytes bytes;
    std::size_t taken = 0;
  };
  template <class T>
  static void take(List& from, std::span<T> to) {
    const auto bytes = std::as_writable_bytes(to);
    std::ranges::copy(files::ByteView(from.bytes).subspan(from.taken, bytes.size()), bytes.begin());
    from.taken += bytes.size();
  }
  std::vector<List> counts_, items_;
};

/// Sends to the first rank, for its RowsOfOthers, the items that this rank has found in its share
/// of the rows.
void send_rows(const Ranks& ranks, std::uint32_t width, std::span<const std::uint32_t> counts,
               files::ByteView items, Traffic& traffic);

/// Gathers in the first rank the items that each rank found in its share of an image's rows: the
/// number of items of each pixel, and all items, pixel by pixel; a rank has no items in other rows.
/// Called by all ranks; other ranks keep their items.
template <class Item>
void gather_rows(const Ranks& ranks, std::uint32_t width, std::span<std::uint32_t> counts,
                 std::vector<Item>& items, Traffic& traffic) {
  static_assert(std::is_trivially_copyable_v<Item>);
  if (!ranks.is_first())
    return send_rows(ranks, width, counts, std::as_bytes(std::span(items)), traffic);
  if (ranks.count() == 1) return;
  RowsOfOthers others(ranks);
  const std::vector<Item> own = std::exchange(items, {});
  std::span<const Item> own_left(own);
  for (std::size_t row = 0; row * width < counts.size(); ++row) {
    const std::size_t rank = share_of(ranks).process_of_row(static_cast<std::uint32_t>(row));
    const std::span<std::uint32_t> of_row = counts.subspan(row * width, width);
    if (rank != 0) others.take_counts(rank, of_row);
    const std::size_t count = std::accumulate(of_row.begin(), of_row.end(), std::size_t{0});
    if (rank == 0) {
      items.insert(items.end(), own_left.begin(),
                   own_left.begin() + static_cast<std::ptrdiff_t>(count));
      own_left = own_left.subspan(count);
    } else {
      items.resize(items.size() + count);
      others.take_items(rank, std::span(items).last(count));
    }
  }
}

/// Chunks of a file that wait for their turn to be written: in memory, or in a file of their own
/// where they would take more of it than they may.
class WaitingChunks {
 public:
  explicit WaitingChunks(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}
  /// Fails    OutputError if the disk is full.
  void add(files::Bytes chunk);
  /// The first chunk that has not been taken.
  /// Fails    InputError if the file cannot be read any more.
  [[nodiscard]] files::Bytes take();
  [[nodiscard]] std::size_t count() const { return chunks_.size(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct Chunk {
    files::Bytes bytes;
    /// In the file, where they are not here.
    std::uint64_t offset = 0, size = 0;
  };
  std::uint64_t most_bytes_, bytes_ = 0;
  std::vector<Chunk> chunks_;
  std::size_t next_ = 0;
  std::optional<files::SpillFile> file_;
};

/// An EXR that the first rank writes, chunk by chunk, as chunks arrive from the ranks that have the
/// rows (image/exr_bands.h): it never holds more of the image than its own chunks and one other
/// chunk. Called by all ranks, with the chunks of their bands, which are consumed.
/// `path`       in the first rank, path of the file; `beginning`: its first bytes
/// `of_chunks`  the rank of each chunk
/// Fails    after everything has been sent: in the first rank OutputError; InputError if own chunks
///          cannot be read.
void write_banded_exr(const Ranks& ranks, const std::filesystem::path& path,
                      const files::Bytes& beginning, std::span<const int> of_chunks,
                      std::uint32_t rows_of_chunk, WaitingChunks& own_chunks);

}  // namespace fathom::app
