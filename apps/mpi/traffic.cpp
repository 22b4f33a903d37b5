#include "apps/mpi/traffic.h"

#include <nlohmann/json.hpp>

#include "apps/shell/standard_streams.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

void sum_up(Traffic& traffic, const Ranks& ranks) {
  traffic.messages = ranks.sum(traffic.messages);
  traffic.bytes = ranks.sum(traffic.bytes);
}

Json to_json(const Traffic& traffic) {
  return {{"messages", traffic.messages}, {"bytes", traffic.bytes}};
}

constexpr double nanoseconds = 1e9;

}  // namespace

void Traffic::add(std::size_t bytes_of_message) {
  ++messages;
  bytes += bytes_of_message;
}

void Traffic::add(std::span<const files::Bytes> messages_to_ranks, int self) {
  for (std::size_t rank = 0; rank < messages_to_ranks.size(); ++rank) {
    if (rank == static_cast<std::size_t>(self) || messages_to_ranks[rank].empty()) continue;
    add(messages_to_ranks[rank].size());
  }
}

void sum_up(MapTraffic& traffic, const Ranks& ranks) {
  traffic.drawn = ranks.sum(traffic.drawn);
  traffic.most_drawn = ranks.greatest(traffic.most_drawn);
  for (Traffic* each : {&traffic.of_triangles, &traffic.of_pixels, &traffic.of_chunks})
    sum_up(*each, ranks);
  // Ranks add whole numbers.
  const auto whole = static_cast<std::uint64_t>(traffic.drawing * nanoseconds);
  traffic.drawing = static_cast<double>(ranks.sum(whole)) / nanoseconds;
  traffic.slowest = static_cast<double>(ranks.greatest(whole)) / nanoseconds;
}

std::string as_json(const std::vector<MapTraffic>& maps, int ranks) {
  std::string lines;
  for (const MapTraffic& map : maps) {
    const Json line{{"map", map.map},
                    {"ranks", ranks},
                    {"triangles", map.triangles},
                    {"drawn", map.drawn},
                    {"most_drawn", map.most_drawn},
                    {"sent",
                     {{"triangles", to_json(map.of_triangles)},
                      {"pixels", to_json(map.of_pixels)},
                      {"chunks", to_json(map.of_chunks)}}},
                    {"seconds", {{"drawing", map.drawing}, {"slowest", map.slowest}}}};
    lines += json_answer(line, -1);
  }
  return lines;
}

}  // namespace fathom::app
