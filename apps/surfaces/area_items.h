#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/mesh/segmentation.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// The kinds of items that have areas.
enum class AreaItemKind { object, face, triangle, material, group, part, label };
/// "object", "face", …
std::string name_of(AreaItemKind kind);
AreaItemKind parse_area_item_kind(const std::string& text);

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
AreaItems area_items(const Scene& scene, AreaItemKind kind);

}  // namespace fathom::app
