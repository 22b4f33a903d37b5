#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/scene/scene.h"
#include "tests/scratch_folder.h"

/// glTF assets made for a test, and what the reader makes of them.
namespace fathom::checks {

using nlohmann::json;
using Triangles = std::vector<CornerIndices>;

struct Read {
  Scene scene;
  Warnings warnings;
};

inline Read read_bytes(std::string_view bytes, const std::filesystem::path& path,
                       const ReadOptions& options) {
  Read result;
  const auto raw = std::as_bytes(std::span(bytes.data(), bytes.size()));
  mesh_files::GltfAsset asset = mesh_files::read_gltf(raw, path, options, result.warnings);
  result.scene = {std::move(asset.meshes), std::move(asset.objects), std::move(asset.buffers)};
  return result;
}

inline Read read_bytes(std::string_view bytes, const std::filesystem::path& path = "test.gltf",
                       bool attributes = true) {
  ReadOptions options;
  options.attributes = attributes;
  return read_bytes(bytes, path, options);
}

inline Read read(const json& asset) {
  return read_bytes(asset.dump());
}

inline std::string fault_in_bytes(const std::string& bytes) {
  return message_of<InputError>([&] { read_bytes(bytes); });
}
inline std::string fault_of(const json& asset) {
  return fault_in_bytes(asset.dump());
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U;
    };
    const unsigned bits = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (unsigned k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  return text;
}

/// Makes assets: a buffer that grows, an accessor and a view per list.
class Asset {
 public:
  json tree{{"asset", {{"version", "2.0"}}},
            {"accessors", json::array()},
            {"bufferViews", json::array()}};
  std::string buffer;

  template <class T>
  int add(const std::vector<T>& numbers, const char* type, int component, bool normalized = false) {
    tree["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", numbers.size() * sizeof(T)}});
    buffer.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    const std::size_t width =
        type == std::string("SCALAR") ? 1 : static_cast<std::size_t>(type[3] - '0');
    json accessor{{"bufferView", tree["bufferViews"].size() - 1},
                  {"componentType", component},
                  {"count", numbers.size() / width},
                  {"type", type}};
    if (normalized) accessor["normalized"] = true;
    tree["accessors"].push_back(accessor);
    return static_cast<int>(tree["accessors"].size()) - 1;
  }
  int positions(const std::vector<float>& numbers) { return add(numbers, "VEC3", 5126); }

  [[nodiscard]] json done() const {
    json result = tree;
    result["buffers"] = {{{"byteLength", buffer.size()},
                          {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    return result;
  }
};

/// Five vertices, (i, i², 0), and one primitive in a node of the only scene.
inline Asset five(json primitive) {
  Asset asset;
  asset.positions({0, 0, 0, 1, 1, 0, 2, 4, 0, 3, 9, 0, 4, 16, 0});
  primitive["attributes"]["POSITION"] = 0;
  asset.tree["meshes"] = {{{"primitives", {primitive}}}};
  asset.tree["nodes"] = {{{"mesh", 0}}};
  asset.tree["scenes"] = {{{"nodes", {0}}}};
  return asset;
}

}  // namespace fathom::checks
