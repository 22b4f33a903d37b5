#include "fathom/mesh_files/gltf/gltf_extensions.h"

#include <set>
#include <string_view>

#include "fathom/mesh_files/gltf/gltf_references.h"
#include "fathom/text/printable.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

/// What is read as the extension says.
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

/// What is about light, matter, sound, meaning or behaviour, and leaves every triangle of the asset
/// at rest where it is.
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
