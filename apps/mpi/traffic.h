#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/mpi/ranks.h"

namespace fathom::app {

/// Messages between ranks and their bytes. A message counts once, even if MPI sends it in pieces.
struct Traffic {
  std::uint64_t messages = 0, bytes = 0;

  void add(std::size_t bytes_of_message);
  /// Adds the messages that `self` sends to other ranks.
  void add(std::span<const files::Bytes> messages_to_ranks, int self);
};

/// Cost of a map, over all ranks.
struct MapTraffic {
  std::string map;  ///< the name of the file
  /// Triangles of the scene; triangles drawn, in total and by the busiest rank.
  std::uint64_t triangles = 0, drawn = 0, most_drawn = 0;
  /// Triangles sent to the ranks that draw them, pixels to the ranks that compress them, and
  /// compressed chunks to the file.
  Traffic of_triangles, of_pixels, of_chunks;
  /// Seconds of drawing: of all ranks together, and of the slowest one.
  double drawing = 0, slowest = 0;
};

/// Combines the figures of all ranks: sums, and the maximum of `most_drawn` and `slowest`. Called
/// by all ranks.
void sum_up(MapTraffic& traffic, const Ranks& ranks);

/// A line of JSON for each map.
std::string as_json(const std::vector<MapTraffic>& maps, int ranks);

}  // namespace fathom::app
