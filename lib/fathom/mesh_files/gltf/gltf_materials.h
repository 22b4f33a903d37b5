#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "fathom/text/json_value.h"

/// The names of glTF's materials and meshes. For this room's .cpp files only.
namespace fathom::mesh_files {

/// The name of an entry of a top-level list; "mesh 3" where it has none.
std::string name_or_number(const text::JsonValue& entry, const char* kind, std::uint64_t index);

/// The materials of an asset. What is wrong with them is no failure: depth does not need them.
class GltfMaterials {
 public:
  explicit GltfMaterials(const text::JsonValue& root);

  /// The number of the material of a primitive, if it has one that is in the file.
  [[nodiscard]] std::optional<std::size_t> of(const text::JsonValue& primitive) const;
  [[nodiscard]] std::string name(std::size_t material) const;

 private:
  /// A list, where there are materials.
  std::optional<text::JsonValue> list_;
};

}  // namespace fathom::mesh_files
