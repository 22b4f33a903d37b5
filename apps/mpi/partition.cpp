#include "apps/mpi/partition.h"

#include <algorithm>

#include "apps/shell/values.h"

namespace fathom::app {
namespace {

/// Cost of a tile without triangles, in triangles. A guess that affects only the balance of the
/// work.
constexpr std::uint64_t cost_of_pixels = 256;

/// The rank in whose part of `whole` the middle of an interval lies.
int rank_at(std::uint64_t before, std::uint64_t cost, std::uint64_t whole, int ranks) {
  const double middle = static_cast<double>(before) + static_cast<double>(cost) / 2;
  return std::min(static_cast<int>(middle / static_cast<double>(whole) * ranks), ranks - 1);
}

std::vector<int> runs_of_equal_load(std::span<const std::uint64_t> triangles, int ranks) {
  std::uint64_t whole = 0, before = 0;
  for (const std::uint64_t count : triangles) whole += count + cost_of_pixels;
  std::vector<int> owners;
  owners.reserve(triangles.size());
  for (const std::uint64_t count : triangles) {
    const std::uint64_t cost = count + cost_of_pixels;
    owners.push_back(rank_at(before, cost, whole, ranks));
    before += cost;
  }
  return owners;
}

}  // namespace

Partition parse_partition(const std::string& text) {
  return parse_word<Partition>(text, {{"load", Partition::load},
                                      {"rows", Partition::rows},
                                      {"round-robin", Partition::round_robin}});
}

std::vector<int> owners_of_tiles(Partition how, std::uint32_t columns, std::uint32_t rows,
                                 std::span<const std::uint64_t> triangles, int ranks) {
  if (how == Partition::load) return runs_of_equal_load(triangles, ranks);
  std::vector<int> owners(std::size_t{columns} * rows);
  for (std::size_t tile = 0; tile < owners.size(); ++tile) {
    owners[tile] = how == Partition::rows
                       ? rank_at(tile / columns, 1, rows, ranks)
                       : static_cast<int>(tile % static_cast<std::size_t>(ranks));
  }
  return owners;
}

}  // namespace fathom::app
