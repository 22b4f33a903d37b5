#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/triangle_source.h"

/// The areas of a scene's triangles that the sun, a lamp or a camera sees, without pixels
/// (specification, section 8).
namespace fathom {

/// A direction, towards the light or against the wind; of any length, but not 0.
using AreaDirection = std::array<double, 3>;
/// The place of a lamp, in the world.
using AreaPoint = std::array<double, 3>;

/// The side of a triangle that faces the light.
enum class LitSide : std::uint8_t { front, back, edge };

/// Areas before they are rounded: of a direction times its length, of a camera in pixels, of a
/// point as shares of the area of the triangle.
struct ExactArea {
  /// Not defined of a group from a point.
  std::optional<Ratio> visible;
  /// Not defined of a group that is not measured alone.
  std::optional<Ratio> projected;
};

/// The area of a triangle, or of a group of triangles. Each number is exact and rounded once.
struct LitArea {
  /// Of a triangle: the side that faces the light; edge if the light sees it edge on. A camera
  /// that mirrors the image sees the same side.
  std::optional<LitSide> side;
  /// The visible area across the direction; from a camera in pixels; not defined from a point.
  std::optional<double> visible;
  /// The area of a triangle across the direction, with all other triangles removed; from a camera
  /// the area within the image. Of a group with AreaOptions::alone, the area that is visible of it
  /// with all other triangles removed.
  std::optional<double> projected;
  /// visible / projected; of a triangle from a point the visible share of its surface. Not defined
  /// if projected is 0.
  std::optional<double> fraction;
  /// The visible area, measured on the surface.
  double lit = 0;
  /// The centroid of the visible part of the surface, in the world; not defined if nothing is
  /// visible.
  std::optional<std::array<double, 3>> centroid;
  /// With AreaOptions::exact.
  std::optional<ExactArea> exact;
};

/// Which area weighs the centroid of a group: the area across the direction, or on the surface.
enum class AreaCentroid : std::uint8_t { across, lit };

struct AreaOptions {
  Cull cull = Cull::none;
  /// 0: all.
  int threads = 0;
  /// For groups under a direction. From a camera and from a point, `lit` is used.
  AreaCentroid centroid = AreaCentroid::across;
  /// Also measure each group with all other triangles removed, which takes about as long for all
  /// groups as the scene does. From a point this has no effect.
  bool alone = false;
  /// Also return areas before they are rounded.
  bool exact = false;
  /// The group of each triangle, below `group_count`, or no_group. If empty, each triangle is
  /// measured by itself.
  std::vector<std::uint32_t> groups;
  std::uint32_t group_count = 0;
  static constexpr std::uint32_t no_group = 0xFFFFFFFF;
};

/// Areas by the numbers of triangles or groups.
/// Fails    InputError if the scene has a fault; UsageError for a direction that is 0 or not
///          finite, or whose magnitude range does not fit that of the scene, and if `groups` is
///          neither empty nor as long as the list of triangles.
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
/// The area of such a camera's image, in pixels, in which no triangle is visible; exact, rounded
/// once. Groups have no effect.
double background_from_camera(const TriangleSource& triangles, const Camera& camera,
                              const AreaOptions& options = {});

/// The kinds of items that have areas.
enum class AreaItemKind : std::uint8_t { object, face, triangle, material, group, part, label };
inline constexpr std::array all_area_item_kinds{
    AreaItemKind::object, AreaItemKind::face, AreaItemKind::triangle, AreaItemKind::material,
    AreaItemKind::group,  AreaItemKind::part, AreaItemKind::label};
/// "object", "face", …
const char* name_of(AreaItemKind kind);
/// Whether the items of a kind are segments, which have to be read with the scene.
constexpr bool are_segments(AreaItemKind kind) {
  return kind >= AreaItemKind::material;
}

/// A triangle, or some triangles that are measured together.
struct AreaItem {
  /// Of its kind: of a triangle in the scene, of a face in its file.
  std::uint64_t number = 0;
  std::string name;
  /// Of triangles and faces.
  std::optional<std::uint32_t> object, face;
};

struct AreaItems {
  std::vector<AreaItem> items;
  /// The item of each triangle, or AreaOptions::no_group; empty if triangles are the items.
  std::vector<std::uint32_t> of_triangle;
};

/// The items of a kind in a scene. Triangles without a material, group, part or label belong to no
/// item.
/// Fails    InputError if an object names no mesh, or there are more than 2³² − 2 triangles.
AreaItems area_items(const Scene& scene, AreaItemKind kind);
/// Options that measure these items.
AreaOptions options_of(const AreaItems& items);

}  // namespace fathom
