#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "apps/rays/columns.h"
#include "fathom/rays/cast.h"

namespace fathom::app {

/// What can be asked of a hit (specification, section 11).
enum class HitChannel { t, id, distance, P, bary, N, object, face };
inline constexpr std::array all_hit_channels{
    HitChannel::t,    HitChannel::id, HitChannel::distance, HitChannel::P,
    HitChannel::bary, HitChannel::N,  HitChannel::object,   HitChannel::face};
std::string_view name_of(HitChannel channel);

/// The channels of hits, in their order; hit i is one of the ray rays[ray_of_hit[i]].
/// distance, P, bary and N take exact numbers, about 10 µs for each hit.
std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads);

}  // namespace fathom::app
