#include "fathom/mesh_files/gltf/gltf_primitive_accessors.h"

#include <span>

#include "fathom/mesh_files/gltf/gltf_asset.h"

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

namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";

/// glTF's name of an attribute, and its member here.
struct NamedAttribute {
  const char* name;
  std::shared_ptr<const GltfAccessor> GltfPrimitiveAccessors::*accessor;
};
constexpr NamedAttribute named_attributes[] = {
    {"POSITION", &GltfPrimitiveAccessors::positions},
    {"TEXCOORD_0", &GltfPrimitiveAccessors::texture_coordinates},
    {"NORMAL", &GltfPrimitiveAccessors::normals},
    {"COLOR_0", &GltfPrimitiveAccessors::colours}};

/// Some programs take Draco's indices for triangles whatever the mode is, others for a strip.
void expect_triangles(const JsonValue& primitive) {
  const auto mode = primitive.find("mode");
  if (mode && mode->integer(0, largest_integer) != 4)
    mode->fail("expected 4, triangles, of a primitive that Draco has compressed");
}

}  // namespace

std::optional<JsonValue> draco_of(const JsonValue& primitive, const GltfAccessors& accessors) {
  auto extension = find_extension(primitive, draco_extension);
  if (!extension || requires_extension(accessors.root(), draco_extension)) return extension;
  const auto positions = primitive.at("attributes").find("POSITION");
  if (positions && accessors.description(*positions).find("bufferView")) return std::nullopt;
  return extension;
}

GltfPrimitiveAccessors decode_draco(const JsonValue& primitive, const JsonValue& extension,
                                    GltfAccessors& accessors, bool attributes) {
  expect_triangles(primitive);
  const JsonValue plain = primitive.at("attributes"), compressed = extension.at("attributes");
  GltfPrimitiveAccessors result;
  if (!plain.find("POSITION")) return result;
  if (!compressed.find("POSITION")) compressed.fail("has no POSITION, expected compressed ones");
  const JsonValue indices = accessors.description(primitive.at("indices"));
  std::vector<GltfDecoders::Wanted> wanted;
  std::vector<std::shared_ptr<const GltfAccessor> GltfPrimitiveAccessors::*> places;
  for (const auto& [name, accessor] : std::span(named_attributes).first(attributes ? 4 : 1)) {
    const auto reference = plain.find(name), number = compressed.find(name);
    if (reference && number) {
      wanted.push_back({static_cast<std::uint32_t>(number->integer(0, 0xFFFFFFFF)),
                        accessors.description(*reference)});
      places.push_back(accessor);
    } else if (reference) {
      result.*accessor = accessors.at(*reference);
    }
  }
  GltfBufferViews& views = accessors.views();
  const GltfDecoders::Primitive decoded = views.decoders().decode_primitive(
      extension, indices, wanted, views.at(extension.at("bufferView")).bytes);
  result.indices = std::make_shared<const GltfAccessor>(indices, decoded.corners);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    result.*places[i] =
        std::make_shared<const GltfAccessor>(wanted[i].accessor, decoded.attributes[i]);
  return result;
}

}  // namespace fathom::mesh_files
