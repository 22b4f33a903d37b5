#include "fathom/mesh_files/gltf/gltf_references.h"

#include <cmath>

namespace fathom::mesh_files {
using namespace text;

std::string name_or_number(const JsonValue& entry, const char* kind, std::uint64_t index) {
  if (entry.is_object())
    if (const auto name = entry.find("name"); name && name->is_string() && !name->string().empty())
      return name->string();
  return std::string(kind) + " " + std::to_string(index);
}

GltfMaterials::GltfMaterials(const JsonValue& root) : list_(root.find("materials")) {
  if (list_ && !list_->is_list()) list_.reset();
}

std::optional<std::size_t> GltfMaterials::of(const JsonValue& primitive) const {
  const auto reference = primitive.find("material");
  if (!list_ || !reference || !reference->is_number()) return std::nullopt;
  const double number = reference->number();
  if (!(number >= 0 && number < static_cast<double>(list_->size())) || number != std::floor(number))
    return std::nullopt;
  return static_cast<std::size_t>(number);
}

std::string GltfMaterials::name(std::size_t material) const {
  return name_or_number(list_->element(material), "material", material);
}

}  // namespace fathom::mesh_files
