#include "apps/rays/hit_columns.h"

#include <algorithm>
#include <string>

#include "fathom/rays/hit_values.h"

namespace fathom::app {
namespace {

constexpr std::array<std::string_view, 8> hit_channel_names{"t",    "id", "distance", "P",
                                                            "bary", "N",  "object",   "face"};

bool is_value(HitChannel channel) {
  return channel == HitChannel::distance || channel == HitChannel::P ||
         channel == HitChannel::bary || channel == HitChannel::N;
}

using Values = std::vector<HitValues<double>>;

Column column_of(HitChannel channel, std::span<const RayHit> hits) {
  Column column{std::string(name_of(channel)), {}, {}};
  if (channel == HitChannel::t) {
    auto& t = column.values.emplace<std::vector<double>>(hits.size());
    std::ranges::transform(hits, t.begin(), &RayHit::t);
  } else {
    auto& id = column.values.emplace<std::vector<std::uint32_t>>(hits.size());
    std::ranges::transform(hits, id.begin(), &RayHit::triangle);
  }
  return column;
}

Column column_of(HitChannel channel, const TriangleSource& triangles,
                 std::span<const RayHit> hits) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(hits.size());
  for (const RayHit& hit : hits) {
    if (hit.triangle == no_triangle) {
      numbers.push_back(no_triangle);
      continue;
    }
    const TriangleOrigin origin = triangles.origin(hit.triangle);
    numbers.push_back(channel == HitChannel::object ? origin.object : origin.face);
  }
  return {std::string(name_of(channel)), {}, std::move(numbers)};
}

Column column_of(HitChannel channel, const Values& values) {
  Column column{std::string(name_of(channel)), {}, {}};
  std::vector<double> numbers;
  const auto append = [&](const auto& of_hit) {
    for (const HitValues<double>& each : values)
      numbers.insert(numbers.end(), (each.*of_hit).begin(), (each.*of_hit).end());
  };
  switch (channel) {
    case HitChannel::P:
      column.parts = {"X", "Y", "Z"};
      append(&HitValues<double>::position);
      break;
    case HitChannel::bary:
      column.parts = {"U", "V"};
      append(&HitValues<double>::barycentric);
      break;
    case HitChannel::N:
      column.parts = {"X", "Y", "Z"};
      append(&HitValues<double>::normal);
      break;
    default:
      for (const HitValues<double>& each : values) numbers.push_back(each.distance);
  }
  column.values = std::move(numbers);
  return column;
}

}  // namespace

std::string_view name_of(HitChannel channel) {
  return hit_channel_names[static_cast<std::size_t>(channel)];
}

std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads) {
  Values values;
  if (std::ranges::any_of(channels, is_value)) {
    std::vector<Ray> of_hits;
    std::vector<std::uint32_t> met;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      of_hits.push_back(rays[ray_of_hit[i]]);
      met.push_back(hits[i].triangle);
    }
    values = hit_values<double>(triangles, of_hits, met, threads);
  }
  std::vector<Column> columns;
  for (const HitChannel channel : channels) {
    if (is_value(channel)) {
      columns.push_back(column_of(channel, values));
    } else if (channel == HitChannel::object || channel == HitChannel::face) {
      columns.push_back(column_of(channel, triangles, hits));
    } else {
      columns.push_back(column_of(channel, hits));
    }
  }
  return columns;
}

}  // namespace fathom::app
