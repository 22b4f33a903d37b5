#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/options/read_limits.h"
#include "apps/shell/command.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// "obj", "ply", … ; fails with UsageError.
MeshFormat parse_mesh_format(const std::string& text);
/// A number of threads, at most 1024; 0: all.
int parse_thread_count(const std::string& text);

/// `SCENE… --mesh-format --threads …`: what every command that reads a scene takes.
struct SceneOptions {
  std::vector<std::string> files;
  std::optional<MeshFormat> mesh_format;
  int threads = 0;
  ReadLimits limits;

  void add_to(Command& command);
  /// All but the files.
  void add_reading_to(Command& command);

  /// What else a reader may keep of a scene.
  struct Extras {
    bool hash = false;        ///< SHA-256 of the sources
    bool attributes = false;  ///< colours, normals and texture coordinates
    bool primitives = false;  ///< lines and points
    bool segments = false;    ///< materials, groups, parts and labels
  };
  /// Reads the scene and passes on the reader's warnings.
  [[nodiscard]] Scene read(const Console& console, const Extras& extras) const;
  [[nodiscard]] Scene read(const Console& console) const { return read(console, Extras()); }

  /// With the format, the threads and the folder that were asked for.
  [[nodiscard]] ReadOptions read_options() const;
};

}  // namespace fathom::app
