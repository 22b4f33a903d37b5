#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/area/areas.h"
#include "fathom/scene/scene.h"

namespace fathom {

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
