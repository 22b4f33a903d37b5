#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "apps/mpi/ranks.h"

namespace fathom::app {

/// How a rank divides its memory limit among its buffers.
struct RankMemory {
  /// Triangles of a round.
  std::uint32_t triangles_at_once;
  /// For tiles that are drawn, and for triangles that channel A needs again; what does not fit
  /// waits in files.
  std::uint64_t tile_bytes, kept_bytes;
  /// For rows of the image that are being gathered; for compressed chunks that are not yet written.
  std::uint64_t row_bytes, chunk_bytes;
  /// For pixels that are sent at a time.
  std::size_t message_bytes;
  /// Triangles of a round that are picked for others at a time, or a few more.
  std::uint32_t sent_at_once;
  /// For triangles that wait to be sent; so many more may be on the way from a rank, on the way to
  /// it, and wait to be drawn (triangle_mail.h).
  std::size_t waiting_bytes;
};

/// The least that can be asked for.
inline constexpr std::uint64_t least_rank_memory = std::uint64_t{128} << 20;

/// The same for all ranks, which call it. The map does not depend on it.
/// `bytes`            as asked for; else, of the least that a rank has, three quarters of an equal
///                    share of what its machine, its control group or --max-memory allows
/// `keeps_triangles`  for channel A
RankMemory memory_of_rank(const Ranks& ranks, const std::optional<std::uint64_t>& bytes,
                          bool keeps_triangles);

/// Makes the process keep memory that a round frees for the next round: getting it again from the
/// system, page by page, took a quarter of a rank's time.
void keep_what_rounds_give_back();

}  // namespace fathom::app
