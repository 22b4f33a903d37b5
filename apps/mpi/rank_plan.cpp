#include "apps/mpi/rank_plan.h"

#include <malloc.h>

#include <algorithm>

#include "apps/shell/max_memory.h"
#include "apps/shell/values.h"
#include "fathom/fast/some_tiles.h"

namespace fathom::app {
namespace {

/// Memory of a rank before it reads anything: the program, its libraries, MPI.
constexpr std::uint64_t program_bytes = std::uint64_t{64} << 20;

/// Of a message.
constexpr std::uint64_t bytes_sent = 100;
/// More makes nothing faster, and MPI counts less than 2³¹ bytes of a message.
constexpr std::uint64_t most_triangles = std::uint64_t{1} << 24,
                        most_waiting = std::uint64_t{1} << 26;

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

RankMemory memory_of_rank(const Ranks& ranks, const std::optional<std::uint64_t>& bytes,
                          bool keeps_triangles) {
  const std::uint64_t share =
      memory_allowance().bytes / static_cast<std::uint64_t>(ranks.count_on_this_machine());
  // How much is sent at a time, and how many rows, is the same in all ranks.
  const std::uint64_t allowed =
      ranks.least(std::max(bytes.value_or(share / 4 * 3), least_rank_memory));
  const std::uint64_t left = allowed - program_bytes;
  // An eighth is for messages. So many bytes wait to be sent, and twice as many and a half are
  // being added to them; as many are on the way from here, twice as many on the way to here, and
  // twice as many have come, which take five times as much while they are drawn: fourteen times in
  // all.
  const std::uint64_t waiting = left / 8 / 14;
  return {.triangles_at_once = static_cast<std::uint32_t>(
              std::min(most_triangles, left / 4 / TilesInRounds::bytes_per_triangle)),
          .tile_bytes = keeps_triangles ? left / 16 * 5 : left / 8 * 5,
          .kept_bytes = keeps_triangles ? left / 16 * 5 : 0,
          .row_bytes = left / 16,
          .chunk_bytes = left / 16,
          .message_bytes = static_cast<std::size_t>(left / 16),
          .sent_at_once = static_cast<std::uint32_t>(
              std::max<std::uint64_t>(1, std::min(most_waiting, waiting) / bytes_sent)),
          .waiting_bytes = static_cast<std::size_t>(std::min(most_waiting, waiting))};
}

void keep_what_rounds_give_back() {
#ifdef M_MMAP_THRESHOLD
  ::mallopt(M_MMAP_THRESHOLD, 1 << 25);  // the most that there can be
  ::mallopt(M_TRIM_THRESHOLD, 1 << 27);
#endif
}

}  // namespace fathom::app
