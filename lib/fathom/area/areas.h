#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

/// How much of its triangles a scene shows to the sun, to a lamp or to a camera, without pixels
/// (specification, section 8).
namespace fathom {

/// A direction, towards the light or against the wind; of any length, but not 0.
using AreaDirection = std::array<double, 3>;
/// The place of a lamp, in the world.
using AreaPoint = std::array<double, 3>;

/// The side of a triangle that faces the light.
enum class LitSide : std::uint8_t { front, back, edge };

/// The area of a triangle, or of a group of triangles. Each number is the exact one, rounded once.
struct LitArea {
  /// Of a triangle: which side faces the light; edge if it is seen edge on.
  std::optional<LitSide> side;
  /// The area across the direction of what is visible; from a camera in pixels; nothing from a
  /// point.
  std::optional<double> visible;
  /// The area of a triangle across the direction, whatever hides it; from a camera the area within
  /// the image.
  std::optional<double> projected;
  /// Of a triangle, visible / projected; from a point the share of the triangle itself.
  std::optional<double> fraction;
  /// The area of what is visible, on the surface itself.
  double lit = 0;
  /// The centre of what is visible, on the surface, in the world; nothing if nothing is visible.
  std::optional<std::array<double, 3>> centroid;
};

/// Which area weighs the centroid of a group: the area across the direction, or on the surface.
enum class AreaCentroid : std::uint8_t { across, lit };

struct AreaOptions {
  Cull cull = Cull::none;
  /// 0: all.
  int threads = 0;
  /// Of a group under a direction. A camera and a point have `lit` alone.
  AreaCentroid centroid = AreaCentroid::across;
  /// The group that each triangle belongs to, below `group_count`, or no_group. Empty: every
  /// triangle is measured for itself.
  std::vector<std::uint32_t> groups;
  std::uint32_t group_count = 0;
  static constexpr std::uint32_t no_group = 0xFFFFFFFF;
};

/// Areas by the numbers of triangles or groups.
/// Fails    InputError where the scene has a fault; UsageError for a direction that is 0 or not
///          finite, or whose numbers are too far apart in magnitude for those of the scene, and
///          where `groups` is not empty and not one number for each triangle.
std::vector<LitArea> areas_in_direction(const TriangleSource& triangles,
                                        const AreaDirection& direction,
                                        const AreaOptions& options = {});
/// The same from a point, which sees in all directions.
/// Fails    as above; UsageError for a point that is not finite.
std::vector<LitArea> areas_from_point(const TriangleSource& triangles, const AreaPoint& point,
                                      const AreaOptions& options = {});
/// The same from a camera without a lens, within its image.
std::vector<LitArea> areas_from_camera(const TriangleSource& triangles, const Camera& camera,
                                       const AreaOptions& options = {});

}  // namespace fathom
