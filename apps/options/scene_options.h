#pragma once

#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// "obj", "ply", … ; fails with UsageError.
MeshFormat parse_mesh_format(const std::string& text);

/// `SCENE… --mesh-format --threads …`: what every command that reads a scene takes.
struct SceneOptions {
  std::vector<std::string> files;
  std::optional<MeshFormat> mesh_format;
  int threads = 0;
  bool outside_files = false;
  std::uint64_t max_expansion = ReadOptions().max_expansion;

  void add_to(Command& command);
  /// Only what limits the files that are read, for a command with arguments of its own.
  void add_limits_to(Command& command);

  /// What else a reader may keep of a scene.
  struct Extras {
    bool hash = false;        ///< SHA-256 of the sources
    bool attributes = false;  ///< colours, normals and texture coordinates
  };
  /// Reads the scene and passes on the reader's warnings.
  [[nodiscard]] Scene read(const Console& console, const Extras& extras) const;
  [[nodiscard]] Scene read(const Console& console) const { return read(console, Extras()); }

  /// With the format and the threads that were asked for.
  [[nodiscard]] ReadOptions read_options() const;
};

}  // namespace fathom::app
