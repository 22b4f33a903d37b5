#include "fathom/mesh_files/gltf_primitive_accessors.h"

#include "fathom/mesh_files/gltf_draco.h"

namespace fathom::mesh_files {
using namespace text;

GltfPrimitiveAccessors open_primitive(const JsonValue& primitive, GltfAccessors& accessors,
                                      bool attributes) {
  const auto open = [&](const JsonValue& object, const char* key) {
    const auto reference = object.find(key);
    return reference ? accessors.at(*reference) : nullptr;
  };
  GltfPrimitiveAccessors result;
  const auto attributes_object = primitive.find("attributes");
  if (!attributes_object) return result;
  const JsonValue& named = *attributes_object;
  if (const auto draco = draco_of(primitive, accessors))
    return decode_draco(primitive, *draco, accessors, attributes);
  result.positions = open(named, "POSITION");
  if (!result.positions) return result;
  result.indices = open(primitive, "indices");
  if (!attributes) return result;
  result.texture_coordinates = open(named, "TEXCOORD_0");
  result.normals = open(named, "NORMAL");
  result.colours = open(named, "COLOR_0");
  return result;
}

}  // namespace fathom::mesh_files
