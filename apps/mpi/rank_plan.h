#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/mpi/ranks.h"

/// How ranks divide the tiles of an image, and each rank its memory.
namespace fathom::app {

/// How the tiles of an image are distributed to the ranks of a run. The map does not depend on it.
enum class Partition {
  /// Runs of neighbouring tiles, row by row, of about equal work for their triangles and pixels.
  /// Neighbours share triangles, which then go to one rank.
  load,
  /// Whole rows of tiles, equally many for each rank.
  rows,
  /// Tile t goes to rank t mod ranks: work is spread without being measured, and more is sent.
  round_robin
};

/// "load", "rows" or "round-robin".
/// Fails    UnknownName.
Partition parse_partition(const std::string& text);

/// The rank of each of columns × rows tiles. Some ranks may get no tile.
/// `triangles`  how many may touch each tile.
std::vector<int> owners_of_tiles(Partition how, std::uint32_t columns, std::uint32_t rows,
                                 std::span<const std::uint64_t> triangles, int ranks);

/// How a rank divides its memory limit among its buffers.
struct RankMemory {
  /// Triangles of a round.
  std::uint32_t triangles_at_once;
  /// For tiles that are drawn, and for triangles that channel A needs again. Data that does not fit
  /// is kept in files.
  std::uint64_t tile_bytes, kept_bytes;
  /// For rows of the image that are being gathered; for compressed chunks that are not yet written.
  std::uint64_t row_bytes, chunk_bytes;
  /// For pixels that are sent at a time.
  std::size_t message_bytes;
  /// Triangles of a round that are picked for others at a time, or a few more.
  std::uint32_t sent_at_once;
  /// For triangles that wait to be sent. As many bytes more may each be undelivered from a rank,
  /// undelivered to it, and waiting to be drawn (triangle_mail.h).
  std::size_t waiting_bytes;
};

/// The least memory that can be requested.
inline constexpr std::uint64_t least_rank_memory = std::uint64_t{128} << 20;

/// Called by all ranks, with the same result. The map does not depend on it.
/// `bytes`            as asked for; else, of the least that a rank has, three quarters of an equal
///                    share of what its machine, its control group or --max-memory allows
/// `keeps_triangles`  for channel A
RankMemory memory_of_rank(const Ranks& ranks, const std::optional<std::uint64_t>& bytes,
                          bool keeps_triangles);

/// Makes the process keep memory that a round frees for the next round: getting it again from the
/// system, page by page, took a quarter of a rank's time.
void keep_what_rounds_give_back();

}  // namespace fathom::app
