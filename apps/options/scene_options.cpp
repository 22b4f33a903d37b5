#include "apps/options/scene_options.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "apps/shell/companion.h"
#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/directions.h"
#include "fathom/image/map_files.h"
#include "fathom/mesh_files/mesh_formats.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

/// Its exit status does not matter: the caller checks whether the program exists afterwards.
void run_to_its_end(char* program) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  // A mesh may stand on standard input.
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  char* const arguments[] = {program, nullptr};
  pid_t child = -1;
  const int error = ::posix_spawn(&child, program, &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  while (error == 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// Path of fathom-formats: in the folder of this program. If it is missing, runs the program named
/// by the environment variable FATHOM_PROVIDE_FORMATS first: scripts/fathom names a script that
/// installs the dependencies and builds fathom-formats. That script's output goes to standard
/// error.
std::filesystem::path formats_program() {
  std::filesystem::path path = companion_path("fathom-formats");
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  if (char* const provider = std::getenv("FATHOM_PROVIDE_FORMATS")) run_to_its_end(provider);
  return path;
}

std::filesystem::path parse_folder(const std::string& text) {
  std::error_code error;
  if (!std::filesystem::is_directory(text, error)) {
    throw UsageError("'" + text + "' is no folder");
  }
  return text;
}

/// A map is a common mistake, since maps carry their camera, but no scene.
void refuse_map(const std::string& file) {
  const std::optional<MapFormat> format = map_format_of(file);
  std::error_code error;
  if (!format || *format == MapFormat::colmap || !std::filesystem::is_regular_file(file, error))
    return;
  throw InputError(file + ": is a map, expected a mesh or a scene file; '--camera " + file +
                   "' takes the camera that a map carries");
}

Cull parse_cull(const std::string& text) {
  return parse_enumerator(text, all_culls);
}

}  // namespace

void ReadLimits::add_to(Command& command) {
  command.flag("--outside-files", outside_files,
               "Allow glTF assets to name files outside their folder");
  add_confine_to(command);
  command.option("--max-expansion", "N", into(max_expansion, parse_count),
                 "Limit a mesh in memory to 64 MiB plus N times the bytes of its files (default "
                 "64); raise it for glTF and scene files that reuse the same data many times");
}

void ReadLimits::add_confine_to(Command& command) {
  command.option(
      "--confine", "DIR", into(confine, parse_folder),
      "Allow scene files, camera files and glTF to open files only below this folder (default: "
      "anywhere)");
}

DirectionReader ReadLimits::directions_beside(const std::string& camera_file) const {
  const std::filesystem::path folder = files::folder_of_input(camera_file);
  const DirectionReader read = fathom::directions_beside(camera_file, confine);
  return [=](const std::string& file, std::uint32_t width, std::uint32_t height) {
    note_input(folder / file);
    return read(file, width, height);
  };
}

ReadOptions ReadLimits::read_options() const {
  ReadOptions options;
  options.outside_files = outside_files;
  options.confine = confine;
  options.max_expansion = max_expansion;
  options.formats_program = formats_program;
  options.map_large_files = true;  // shell/last_resort.h handles SIGBUS
  return options;
}

int parse_thread_count(const std::string& text) {
  const std::uint32_t count = parse_count(text);
  if (count > 1024) throw UsageError("'" + text + "' is more than 1024");
  return static_cast<int>(count);
}

FileFormat parse_mesh_format(const std::string& text) {
  if (const auto format = mesh_files::mesh_format_named(text)) return *format;
  refuse_word(text, mesh_files::words_of_mesh_formats());
}

void SceneOptions::add_to(Command& command) {
  command
      .arguments("SCENE", files,
                 "Meshes (" + mesh_files::names_of_mesh_formats() +
                     "/GLB; FBX, COLLADA, 3DS, 3MF and others by assimp) "
                     "and scene files (JSON); - is standard input")
      .required();
  add_reading_to(command);
}

void SceneOptions::add_reading_to(Command& command) {
  command.option("--mesh-format", "NAME", into(mesh_format, parse_mesh_format),
                 "Format of the meshes: " + joined(mesh_files::words_of_mesh_formats(), " or ") +
                     " (default: by content)");
  command.option("--threads", "N", into(threads, parse_thread_count),
                 "Threads to use (default 0: all)");
  limits.add_to(command);
}

ReadOptions SceneOptions::read_options() const {
  ReadOptions options = limits.read_options();
  options.format = mesh_format;
  options.threads = threads;
  return options;
}

Scene SceneOptions::read(const Console& console, const Extras& extras) const {
  const auto standard_inputs = std::count(files.begin(), files.end(), "-");
  if (standard_inputs > 1) throw UsageError("SCENE: '-', standard input, can be read only once");
  if (!mesh_format) std::ranges::for_each(files, refuse_map);
  ReadOptions options = read_options();
  options.hash = extras.hash;
  options.attributes = extras.attributes;
  options.primitives = extras.primitives;
  options.segments = extras.segments;
  options.clouds = extras.clouds;
  Warnings warnings;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  for (const Source& source : scene.sources) note_input(source.path);
  return scene;
}

void MotionOptions::add_to(Command& command) {
  command.option("--motion", "FILE", file,
                 "Keyframes of moving objects (JSON; see pipeline.md in the documentation); the "
                 "default camera frames the scene without motion");
  command.option("--time", "T", into(time, parse_number),
                 "Time at which to place the objects of --motion (default 0)");
}

MovingScene MotionOptions::moving(Scene scene) const {
  const files::InputFile input{std::filesystem::path(file)};
  note_input(file);
  Motion motion = read_motion(input.text(), file);
  scene.sources.push_back({file, files::sha256(input.bytes()), ""});
  return {std::move(scene), std::move(motion)};
}

Scene MotionOptions::placed(Scene scene) const {
  if (is_given()) return moving(std::move(scene)).take(time_or_start());
  if (time) throw UsageError("--time needs --motion, a file with the keyframes of objects");
  return scene;
}

void MotionOptions::describe(DepthMap& map, double at) const {
  if (is_given()) map.texts[time_text] = fmt::format("{}", at);
}

void add_cull_option(Command& command, Cull& cull) {
  command.option(
      "--cull", "NAME", into(cull, parse_cull),
      "Leave out triangles that show their back or front: back, front or none (default)");
}

}  // namespace fathom::app
