#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/depth_map.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/motion.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// `--outside-files --confine --max-expansion`: which files an untrusted file may name, and how
/// much memory it may fill. Every command that reads a scene takes them.
struct ReadLimits {
  bool outside_files = false;
  std::filesystem::path confine;
  std::uint64_t max_expansion = ReadOptions().max_expansion;

  void add_to(Command& command);
  /// `--confine` alone, for a command that reads no scene.
  void add_confine_to(Command& command);
  /// Reads the tables that a camera file names, which are inputs of this run.
  [[nodiscard]] DirectionReader directions_beside(const std::string& camera_file) const;
  /// Options with these limits and with the program that reads foreign formats, and defaults
  /// otherwise.
  [[nodiscard]] ReadOptions read_options() const;
};

/// "obj", "ply", … ; fails with UsageError.
FileFormat parse_mesh_format(const std::string& text);
/// A number of threads, at most 1024; 0: all.
int parse_thread_count(const std::string& text);

/// `SCENE… --mesh-format --threads …`: the arguments of every command that reads a scene.
struct SceneOptions {
  std::vector<std::string> files;
  std::optional<FileFormat> mesh_format;
  int threads = 0;
  ReadLimits limits;

  void add_to(Command& command);
  /// All but the files.
  void add_reading_to(Command& command);

  /// Additional data of a scene that a reader may keep.
  struct Extras {
    bool hash = false;        ///< SHA-256 of the sources
    bool attributes = false;  ///< colours, normals and texture coordinates
    bool primitives = false;  ///< lines and points
    bool segments = false;    ///< materials, groups, parts and labels
    bool clouds = false;      ///< vertices without faces: no warning of them
  };
  /// Reads the scene and passes on the reader's warnings.
  [[nodiscard]] Scene read(const Console& console, const Extras& extras) const;
  [[nodiscard]] Scene read(const Console& console) const { return read(console, Extras()); }

  /// Options with the requested format, threads and folder.
  [[nodiscard]] ReadOptions read_options() const;
};

/// `--motion FILE --time T`: moving objects, and the time of the map.
struct MotionOptions {
  std::string file;  ///< empty: nothing moves
  std::optional<double> time;

  void add_to(Command& command);

  [[nodiscard]] bool is_given() const { return !file.empty(); }
  /// The time, or 0 if no time is given.
  [[nodiscard]] double time_or_start() const { return time.value_or(0); }
  /// The scene with its motion, whose file becomes one of its sources.
  /// Fails    as read_motion and MovingScene.
  [[nodiscard]] MovingScene moving(Scene scene) const;
  /// The scene at the time; unchanged if nothing moves.
  /// Fails    also UsageError for a time without a motion.
  [[nodiscard]] Scene placed(Scene scene) const;
  /// Adds the text fathom.time, without which the map could not be computed again.
  void describe(DepthMap& map, double at) const;
};

/// `--cull`
void add_cull_option(Command& command, Cull& cull);

}  // namespace fathom::app
