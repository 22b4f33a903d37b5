#pragma once

#include <optional>

#include "fathom/text/warnings.h"

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

}  // namespace fathom
