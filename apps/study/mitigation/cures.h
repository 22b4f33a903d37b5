#pragma once

#include <string>
#include <vector>

#include "apps/study/z_fighting/scene_fights.h"

/// Remedies against z-fighting, and the z-fighting that remains.
namespace fathom::studies {

/// The storage that is to be cured. Cures keep it unless they name another one.
inline constexpr Storage uncured_storage = Storage::unorm24;
DepthFormat uncured_format(const Camera& camera);

/// The whole scene in another format, or with another near plane.
struct Cure {
  std::string name;
  SceneFights fights;
};
/// Near planes farther and farther away, by factors of two, up to the nearest visible surface, so
/// that nothing is cut away.
std::vector<Cure> farther_near_planes(const SceneView& view, const DepthMap& visible);
std::vector<Cure> other_formats(const SceneView& view, const DepthMap& visible);

/// The least visible depth; +∞ if nothing is visible.
double nearest_depth(const DepthMap& visible);

inline constexpr double offset_factors[] = {0, -0.5, -1, -2, -4};
inline constexpr double offset_units[] = {0, -1, -2, -4, -16, -64, -256, -1024, -4096};
/// Polygon offset, factor by factor, for the triangles of all objects except the first. Empty for a
/// single object, or without perspective.
std::vector<OffsetCount> polygon_offsets(const SceneView& view);

}  // namespace fathom::studies
