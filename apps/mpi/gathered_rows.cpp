#include "apps/mpi/gathered_rows.h"

namespace fathom::app {
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

}  // namespace fathom::app
