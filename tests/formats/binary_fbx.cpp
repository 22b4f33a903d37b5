#include "binary_fbx.h"

#include <cstdint>
#include <cstring>
#include <string_view>

namespace fathom::test {
namespace {

template <class T>
std::string bytes_of(T number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::string length_of(std::size_t length) {
  return bytes_of(static_cast<std::uint32_t>(length));
}

// Properties of nodes: a letter for the type, and the bytes.

std::string number(std::int32_t value) {
  return "I" + bytes_of(value);
}

std::string id(std::int64_t value) {
  return "L" + bytes_of(value);
}

std::string text(std::string_view value) {
  return "S" + length_of(value.size()) + std::string(value);
}

template <class T>
std::string list(char type, const std::vector<T>& values) {
  const std::size_t size = values.size() * sizeof(T);
  const std::string head = type + length_of(values.size()) + length_of(0);  // not compressed
  return head + length_of(size) + std::string(reinterpret_cast<const char*>(values.data()), size);
}

struct Node {
  std::string name;
  std::vector<std::string> properties;
  std::vector<Node> nodes;
};

/// The end of a list of nodes: one of which everything is 0.
const std::string end_of_nodes(13, '\0');

void append(const Node& node, std::string& file) {
  const std::size_t start = file.size();
  std::string properties;
  for (const std::string& property : node.properties) properties += property;
  file += length_of(0) + length_of(node.properties.size()) + length_of(properties.size()) +
          static_cast<char>(node.name.size()) + node.name + properties;
  for (const Node& inner : node.nodes) append(inner, file);
  if (!node.nodes.empty()) file += end_of_nodes;
  file.replace(start, 4, length_of(file.size()));  // where it ends
}

Node geometry(const Polygons& polygons) {
  std::vector<double> positions;
  for (const MeshPoint& p : polygons.vertices) positions.insert(positions.end(), {p.x, p.y, p.z});
  std::vector<std::int32_t> corners;
  for (const auto& face : polygons.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    corners.back() = ~corners.back();  // the last of its face
  }
  return {
      "Geometry",
      {id(1), text(std::string_view("thing\0\1Geometry", 15)), text("Mesh")},
      {{"Vertices", {list('d', positions)}, {}}, {"PolygonVertexIndex", {list('i', corners)}, {}}}};
}

}  // namespace

std::string binary_fbx(const Polygons& polygons) {
  const Node model{"Model",
                   {id(2), text(std::string_view("thing\0\1Model", 12)), text("Mesh")},
                   {{"Version", {number(232)}, {}}}};
  std::string file = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + length_of(7400);
  append({"FBXHeaderExtension", {}, {{"FBXVersion", {number(7400)}, {}}}}, file);
  append({"Objects", {}, {geometry(polygons), model}}, file);
  append({"Connections",
          {},
          {{"C", {text("OO"), id(1), id(2)}, {}}, {"C", {text("OO"), id(2), id(0)}, {}}}},
         file);
  return file + end_of_nodes;
}

}  // namespace fathom::test
