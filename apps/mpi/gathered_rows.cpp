#include "apps/mpi/gathered_rows.h"

#include <algorithm>
#include <numeric>

namespace fathom::app {
using namespace text;

namespace {

/// Takes bytes from the beginning of a list.
ByteView take(ByteView& from, std::size_t count) {
  const ByteView taken = from.first(count);
  from = from.subspan(count);
  return taken;
}

/// The rows of a share, of what has been found in all of them.
std::vector<std::uint32_t> counts_in(const RowShare& share, std::uint32_t width,
                                     const std::vector<std::uint32_t>& counts) {
  std::vector<std::uint32_t> own;
  for (std::size_t row = 0; row * width < counts.size(); ++row) {
    if (!share.has_row(static_cast<std::uint32_t>(row))) continue;
    const auto first = counts.begin() + static_cast<std::ptrdiff_t>(row * width);
    own.insert(own.end(), first, first + width);
  }
  return own;
}

}  // namespace

RowShare share_of(const Ranks& ranks) {
  return {static_cast<std::uint32_t>(ranks.self()), static_cast<std::uint32_t>(ranks.count())};
}

void gather_rows(const Ranks& ranks, std::uint32_t width, std::size_t bytes_of_item,
                 PixelItems& items, Traffic& traffic) {
  const RowShare share = share_of(ranks);
  if (!ranks.is_first()) {
    const std::vector<std::uint32_t> counts = counts_in(share, width, items.counts);
    for (const ByteView message : {std::as_bytes(std::span(counts)), ByteView(items.items)}) {
      ranks.send_to_first(message);
      traffic.add(message.size());
    }
    return;
  }
  // What each rank has, and of that, what has not been taken yet.
  std::vector<Bytes> counts(share.processes), lists(share.processes);
  lists[0] = std::move(items.items);
  for (int rank = 1; rank < ranks.count(); ++rank) {
    counts[static_cast<std::size_t>(rank)] = ranks.receive_from(rank);
    lists[static_cast<std::size_t>(rank)] = ranks.receive_from(rank);
  }
  std::vector<ByteView> counts_left(counts.begin(), counts.end()),
      lists_left(lists.begin(), lists.end());
  items.items = Bytes();
  for (std::size_t row = 0; row * width < items.counts.size(); ++row) {
    const std::size_t rank = row / RowShare::rows_per_band % share.processes;
    const std::span<std::uint32_t> of_row(items.counts.data() + row * width, width);
    if (rank != 0)
      std::ranges::copy(take(counts_left[rank], of_row.size_bytes()),
                        std::as_writable_bytes(of_row).begin());
    const std::size_t count = std::accumulate(of_row.begin(), of_row.end(), std::size_t{0});
    append(items.items, take(lists_left[rank], count * bytes_of_item));
  }
}

}  // namespace fathom::app
