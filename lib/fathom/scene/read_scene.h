#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fathom/scene/camera.h"
#include "fathom/scene/scene.h"

namespace fathom {

enum class MeshFormat { obj, ply, stl, off, gltf };

struct ReadOptions {
  /// Takes the place of recognition by content and suffix; needed for standard input.
  std::optional<MeshFormat> format;
  /// Threads to use; 0: all.
  int threads = 0;
  /// Texture coordinates, normals and colours are kept only where this is set; depth maps do
  /// not need them.
  bool attributes = false;
  /// Compute Source::sha256.
  bool hash = true;
};

/// Reads meshes (OBJ, PLY, STL, OFF, glTF/GLB) and scene files (JSON) in the order given into one
/// scene. A mesh is told by its content where the suffix lies. "-" is standard input.
/// Fails    InputError: one line, "FILE: line N: what is wrong and what was expected" (text), or
///          "FILE: byte N: …" (binary). Overall more than 2³² − 2 triangles are an error.
Scene read_scene(const std::vector<std::filesystem::path>& files, const ReadOptions& options,
                 Warnings& warnings);

/// Reads a camera file: one camera, or a list of them (a camera path).
/// Fails    InputError, naming the key; unknown keys are errors.
std::vector<Camera> read_cameras(const std::filesystem::path& file);

/// The camera files' JSON with every number to 17 significant digits, so that reading it gives the
/// same camera bit for bit. Ends without a newline.
std::string to_json(const Camera& camera);
/// A list of cameras; a single one is written as an object.
std::string to_json(const std::vector<Camera>& cameras);

}  // namespace fathom
