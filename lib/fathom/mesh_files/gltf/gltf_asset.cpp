#include "fathom/mesh_files/gltf/gltf_asset.h"

#include <cmath>
#include <set>
#include <string_view>

#include "fathom/text/printable.h"

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

namespace {

/// Extensions that are implemented.
bool is_supported(std::string_view name) {
  static const std::set<std::string_view> names{
      "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
      "EXT_meshopt_compression", "KHR_meshopt_compression"};
  return names.contains(name);
}

/// Images in other formats, and where on a surface they lie.
bool is_of_textures(std::string_view name) {
  return name.starts_with("KHR_texture_") || name.starts_with("EXT_texture_") ||
         name.starts_with("MSFT_texture_") || name.starts_with("MSFT_packing_");
}

/// Extensions for light, materials, sound, metadata or behaviour, which do not move any triangle of
/// the asset at rest.
bool is_not_of_geometry(std::string_view name) {
  static const std::set<std::string_view> names{
      "AGI_articulations",        "AGI_stk_metadata",
      "CESIUM_primitive_outline", "EXT_instance_features",
      "EXT_lights_ies",           "EXT_lights_image_based",
      "EXT_mesh_features",        "EXT_structural_metadata",
      "FB_geometry_metadata",     "KHR_animation_pointer",
      "KHR_audio_emitter",        "KHR_implicit_shapes",
      "KHR_interactivity",        "KHR_lights_punctual",
      "KHR_node_hoverability",    "KHR_node_selectability",
      "KHR_physics_rigid_bodies", "KHR_xmp",
      "KHR_xmp_json_ld",          "MSFT_lod",
      "MSFT_audio_emitter"};
  return names.contains(name) || name.starts_with("KHR_materials_") ||
         name.starts_with("EXT_materials_") || name.starts_with("ADOBE_materials_");
}

bool lists(const JsonValue& root, const char* list, const char* name) {
  const auto names = root.find(list);
  bool found = false;
  if (names)
    for_each_entry(*names, [&](const JsonValue& entry) { found |= entry.string() == name; });
  return found;
}

}  // namespace

void check_required_extensions(const JsonValue& root, bool attributes, const std::string& file,
                               Warnings& warnings) {
  const auto required = root.find("extensionsRequired");
  if (!required) return;
  for_each_entry(*required, [&](const JsonValue& extension) {
    const std::string& name = extension.string();
    if (is_supported(name) || is_not_of_geometry(name)) return;
    if (!is_of_textures(name))
      extension.fail("the required extension " + printable(name.substr(0, 60)) +
                     " is not supported");
    if (attributes)
      warnings.push_back(file + ": the required extension " + printable(name.substr(0, 60)) +
                         " is about textures; none is read");
  });
}

bool uses_extension(const JsonValue& root, const char* name) {
  return lists(root, "extensionsUsed", name);
}

bool requires_extension(const JsonValue& root, const char* name) {
  return lists(root, "extensionsRequired", name);
}

std::optional<JsonValue> find_extension(const JsonValue& part, const char* name) {
  const auto extensions = part.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

}  // namespace fathom::mesh_files
