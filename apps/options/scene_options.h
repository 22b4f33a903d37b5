#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"

namespace fathom::app {

/// `SCENE… --mesh-format --threads`: what every command that looks at a scene takes.
struct SceneOptions {
  std::vector<std::string> files;
  std::string mesh_format;
  std::string threads = "0";

  void add_to(CLI::App& command);
  [[nodiscard]] int thread_count() const;
  /// Reads the scene, says the warnings. `hash` computes the sources' SHA-256; `attributes` keeps
  /// colours, normals and texture coordinates.
  [[nodiscard]] Scene read(const Console& console, bool hash, bool attributes = false) const;
  /// Opens the scene, which stays in its files, says the warnings.
  [[nodiscard]] StreamedScene stream(const Console& console) const;

 private:
  [[nodiscard]] ReadOptions read_options(bool hash) const;
};

}  // namespace fathom::app
