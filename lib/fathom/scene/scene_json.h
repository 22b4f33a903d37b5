#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/scene/scene.h"

namespace fathom::text {
class JsonValue;
}

namespace fathom::scene {

/// A transform of a file: 3×4, or 4×4 with the last row 0 0 0 1.
/// Fails    InputError, naming the key.
WorldFromMesh read_transform(const text::JsonValue& value);

/// One mesh of a scene file.
struct PlacedFile {
  /// The path in the scene file; relative paths start from the scene file's folder.
  std::filesystem::path file;
  std::optional<std::string> name;
  std::optional<WorldFromMesh> transform;
  DrawState draw;
  /// For all its triangles; overrides the mesh file.
  std::optional<std::string> material;
  std::optional<std::uint32_t> label;
};

/// Reads a scene file: {"meshes": [{"file", "transform", "name", "draw", "material", "label"}]},
/// all but the first optional; read_draw_state() in scene_json.cpp has "draw".
/// Fails    InputError, naming the key; unknown keys are errors.
std::vector<PlacedFile> read_scene_json(std::string_view text, const std::filesystem::path& path);

}  // namespace fathom::scene
