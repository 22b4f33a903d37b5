#include "apps/mpi/rank_memory.h"

#include <malloc.h>

#include <algorithm>

#include "apps/shell/max_memory.h"
#include "fathom/fast/some_tiles.h"

namespace fathom::app {
namespace {

/// What a rank takes before it has read anything: the program, its libraries, MPI.
constexpr std::uint64_t program_bytes = std::uint64_t{64} << 20;

/// A triangle that is drawn, and its copies on the way to another rank: picked, and in a message. What
/// comes from others takes less, and is drawn when these are gone.
constexpr std::uint64_t bytes_per_triangle = TilesInRounds::bytes_per_triangle + 200;
/// Of a message.
constexpr std::uint64_t bytes_sent = 88;

}  // namespace

RankMemory memory_of_rank(const Ranks& ranks, const std::optional<std::uint64_t>& bytes,
                          bool keeps_triangles) {
  const std::uint64_t share =
      memory_allowance().bytes / static_cast<std::uint64_t>(ranks.count_on_this_machine());
  // How much is sent at a time, and how many rows, is the same in all ranks.
  const std::uint64_t allowed =
      ranks.least(std::max(bytes.value_or(share / 4 * 3), least_rank_memory));
  const std::uint64_t left = allowed - program_bytes;
  constexpr std::uint64_t most_triangles = std::uint64_t{1} << 24, least_triangles = 4096;
  // All others may have all of a round for one rank.
  const auto others = static_cast<std::uint64_t>(std::max(1, ranks.count() - 1));
  const std::uint64_t from_all = std::max(least_triangles, left / 8 / bytes_sent / others);
  return {.triangles_at_once = static_cast<std::uint32_t>(
              std::min({most_triangles, left / 4 / bytes_per_triangle, from_all})),
          .tile_bytes = keeps_triangles ? left / 16 * 5 : left / 8 * 5,
          .kept_bytes = keeps_triangles ? left / 16 * 5 : 0,
          .row_bytes = left / 16,
          .chunk_bytes = left / 16,
          .message_bytes = static_cast<std::size_t>(left / 16)};
}

void keep_what_rounds_give_back() {
#ifdef M_MMAP_THRESHOLD
  ::mallopt(M_MMAP_THRESHOLD, 1 << 25);  // the most that there can be
  ::mallopt(M_TRIM_THRESHOLD, 1 << 27);
#endif
}

}  // namespace fathom::app
