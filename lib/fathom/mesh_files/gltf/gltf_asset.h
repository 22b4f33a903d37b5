#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/text/json_value.h"

/// The JSON of a glTF asset: entries that refer to each other by their numbers in lists, materials,
/// extensions. Only for .cpp files of this module.
namespace fathom::mesh_files {

/// The greatest integer of a glTF file if nothing else limits it.
inline constexpr std::uint64_t largest_integer = std::numeric_limits<std::uint64_t>::max();

inline std::uint64_t optional_integer(const text::JsonValue& object, const char* key,
                                      std::uint64_t otherwise) {
  const auto value = object.find(key);
  return value ? value->integer(0, largest_integer) : otherwise;
}

/// The entry of a top-level list that `reference` names by its number.
inline text::JsonValue referred(const text::JsonValue& root, const char* list,
                                const text::JsonValue& reference) {
  const std::uint64_t index = reference.integer(0, largest_integer);
  const auto entries = root.find(list);
  if (!entries || index >= entries->size())
    reference.fail("there is no entry " + std::to_string(index) + " in " + list);
  return entries->element(index);
}

/// Calls visit(entry) for each entry of a list. (JsonValue::elements() copies a long one.)
template <class Visit>
void for_each_entry(const text::JsonValue& list, const Visit& visit) {
  if (!list.is_list()) list.fail("expected a list");
  for (std::size_t i = 0; i < list.size(); ++i) visit(list.element(i));
}

/// The name of an entry of a top-level list; "mesh 3" where it has none.
std::string name_or_number(const text::JsonValue& entry, const char* kind, std::uint64_t index);

/// The materials of an asset. Faults of materials are ignored: depth does not need them.
class GltfMaterials {
 public:
  explicit GltfMaterials(const text::JsonValue& root);

  /// The number of a primitive's material; nullopt if the primitive has no material or an unknown
  /// one.
  [[nodiscard]] std::optional<std::size_t> of(const text::JsonValue& primitive) const;
  [[nodiscard]] std::string name(std::size_t material) const;

 private:
  /// A list, where there are materials.
  std::optional<text::JsonValue> list_;
};

/// Refuses an asset that requires an extension that could change the place of its triangles and is
/// not implemented. Warns of extensions that change textures if `attributes` are requested: no
/// image of an asset is opened.
/// Fails    InputError that names the extension.
/// Source   [GLTF20] 3.12 (extensions)
void check_required_extensions(const text::JsonValue& root, bool attributes,
                               const std::string& file, Warnings& warnings);

/// Whether the asset lists an extension as used, or as required.
bool uses_extension(const text::JsonValue& root, const char* name);
bool requires_extension(const text::JsonValue& root, const char* name);

/// The data of an extension in a part of the asset.
std::optional<text::JsonValue> find_extension(const text::JsonValue& part, const char* name);

}  // namespace fathom::mesh_files
