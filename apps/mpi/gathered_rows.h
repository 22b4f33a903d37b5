#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/traffic.h"
#include "fathom/image/row_share.h"
#include "fathom/text/file_bytes.h"

namespace fathom::app {

/// Which rows of an image a rank makes by itself, where each has the whole scene.
RowShare share_of(const Ranks& ranks);

/// Items of the pixels of an image, row by row: how many each pixel has, and all of them, one after another.
struct PixelItems {
  std::vector<std::uint32_t> counts;
  text::Bytes items;
};

/// Puts together in the first rank what each has found in its share of the rows; other rows of it have
/// nothing. Called by all ranks; the others keep what they have.
void gather_rows(const Ranks& ranks, std::uint32_t width, std::size_t bytes_of_item,
                 PixelItems& items, Traffic& traffic);

/// The same of lists of items.
template <class Item>
void gather_rows(const Ranks& ranks, std::uint32_t width, std::vector<std::uint32_t>& counts,
                 std::vector<Item>& items, Traffic& traffic) {
  static_assert(std::is_trivially_copyable_v<Item>);
  if (ranks.count() == 1) return;
  const auto bytes = std::as_bytes(std::span(items));
  PixelItems all{std::move(counts), {bytes.begin(), bytes.end()}};
  items = std::vector<Item>();  // {} would keep its memory
  gather_rows(ranks, width, sizeof(Item), all, traffic);
  counts = std::move(all.counts);
  items.resize(all.items.size() / sizeof(Item));
  if (!items.empty()) std::memcpy(items.data(), all.items.data(), all.items.size());
}

}  // namespace fathom::app
