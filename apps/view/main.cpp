// fathom-view: maps in a page for a browser, and a server that answers its questions.

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/map_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/folder_argument.h"
#include "apps/shell/known_files.h"
#include "apps/shell/max_memory.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/surfaces/probe_answer.h"
#include "apps/view/page.h"
#include "apps/view/probe_server.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/source.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/map_formats.h"
#include "fathom/reference/probe.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

/// A name for a page in a new folder of its own, below $TMPDIR, which only the user can read.
/// Fails    OutputError.
std::filesystem::path new_page_path() {
  std::error_code error;
  std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw OutputError("TMPDIR: " + error.message());
  std::string folder = (parent / "fathom-view-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) fail_with_errno(folder, errno);
  return std::filesystem::path(folder) / "map.html";
}

bool is_set(const char* variable) {
  const char* const value = ::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// Opens a file or an address in the system's browser, by xdg-open or the program of $BROWSER. Does
/// not wait for it. Without $BROWSER and without a display it only warns.
/// Fails    OutputError where there is no such program.
void open_in_browser(const std::string& page, const Console& console) {
  const bool is_chosen = is_set("BROWSER");
  if (!is_chosen && !is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
    console.warn("no display for a browser: open " + page +
                 " yourself, or name a browser in BROWSER");
    return;
  }
  std::string program = is_chosen ? ::getenv("BROWSER") : "xdg-open", argument = page;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  // xdg-open reports each browser that is not there.
  if (!is_chosen)
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw OutputError("no browser: '" + program + "' cannot be started; open " + page +
                      " yourself, or name a browser in BROWSER");
  }
}

// fathom view MAP [OTHER]… [-o PAGE] [--scene SCENE --serve]

using view::ViewedMap;

struct ViewArguments {
  std::vector<std::string> maps;
  std::string output, scene, camera;
  /// Without its list of files.
  SceneOptions reading;
  bool open = false, serve = false;
};

std::string parse_page_name(const std::string& text) {
  const std::string suffix = std::filesystem::path(text).extension().string();
  if (suffix == ".html" || suffix == ".htm" || is_written_through(text)) return text;
  throw UsageError("'" + text + "' does not end in .html");
}

/// A map, a deep map, or the maps of a report; the file is read once, so that it can be a pipe.
std::vector<ViewedMap> read_viewed(const std::string& file) {
  const files::InputFile input(file, files::InputFile::Reading::mapped_where_large);
  std::vector<ViewedMap> maps;
  if (view::is_report(input.text())) {
    note_input(file);
    maps = view::maps_of_report(input.text(), file, memory_allowance().bytes);
  } else {
    ViewedMap& viewed = maps.emplace_back();
    viewed.name = file;
    if (is_deep_map(input.bytes())) {
      viewed.deep = read_deep_map_argument(input.bytes(), file);
      viewed.map = flat_map(*viewed.deep);
    } else {
      viewed.map = with_matte_names(read_map_argument(input.bytes(), file));
    }
    viewed.camera = camera_of(viewed.map, file);
  }
  input.expect_unchanged();
  for (const ViewedMap& viewed : maps) require_valid(viewed.map);
  return maps;
}

/// The cameras of --camera: a single camera for all maps, a camera for each map in order, or
/// cameras that are named like the maps.
void take_cameras(std::vector<ViewedMap>& maps, const ViewArguments& arguments,
                  const Console& console) {
  if (arguments.camera.empty()) return;
  std::vector<Camera> cameras =
      read_cameras_with_lenses(arguments.camera, arguments.reading.limits, console);
  if (cameras.size() == 1) cameras.resize(maps.size(), Camera(cameras.front()));
  std::vector<std::string> names;
  names.reserve(maps.size());
  for (const ViewedMap& viewed : maps) names.push_back(viewed.name);
  cameras = cameras_of_maps(names, cameras);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    require_size_of(maps[k].map, cameras[k], arguments.camera);
    maps[k].camera = std::move(cameras[k]);
  }
}

std::vector<ViewedMap> read_maps(const ViewArguments& arguments, const Console& console) {
  std::vector<ViewedMap> maps;
  for (const std::string& file : arguments.maps) {
    std::vector<ViewedMap> some = read_viewed(file);
    std::move(some.begin(), some.end(), std::back_inserter(maps));
  }
  take_cameras(maps, arguments, console);
  return maps;
}

void write_page_to(const std::filesystem::path& path, const std::vector<ViewedMap>& maps,
                   const Console& console) {
  std::ofstream file(path, std::ios::binary);
  Progress progress(console, "packing");
  view::write_page(
      maps, view::Questions::none, [&](std::string_view part) { file << part; },
      progress.reporter());
  file.close();
  if (!file) throw OutputError(path.string() + ": cannot be written");
}

int write_and_open(const ViewArguments& arguments, const std::vector<ViewedMap>& maps,
                   const Console& console) {
  const bool is_temporary = arguments.output.empty();
  const std::filesystem::path page =
      is_temporary ? new_page_path() : std::filesystem::path(arguments.output);
  OutputFile output(page);
  output.write([&](const auto& path) {
    with_threads(arguments.reading.threads, [&] { write_page_to(path, maps, console); });
  });
  output.commit();
  if (is_temporary) print(page.string() + "\n");
  if (is_temporary || arguments.open)
    open_in_browser(std::filesystem::absolute(page).string(), console);
  return done;
}

/// The files that the text of a map lists; none where another program wrote another list.
std::vector<Source> listed_sources(const std::string& list, const std::string& map) {
  std::vector<Source> sources;
  try {
    const text::JsonDocument document(list, map);
    for (const text::JsonValue& source : document.root().elements())
      sources.push_back({source.at("file").string(), source.at("sha256").string(), ""});
  } catch (const InputError&) {
    return {};
  }
  return sources;
}

/// A note if the map was rendered from a file that is not among the files of the scene: its probes
/// explain other triangles. Empty otherwise, and for a map that does not name its files.
std::string note_of_another_scene(const ViewedMap& viewed, const Scene& scene) {
  const auto text = viewed.map.texts.find(sources_text);
  if (text == viewed.map.texts.end()) return {};
  std::vector<std::string> others;
  for (const Source& source : listed_sources(text->second, viewed.name)) {
    const bool is_known =
        source.sha256.empty() ||
        std::ranges::find(scene.sources, source.sha256, &Source::sha256) != scene.sources.end();
    if (!is_known) others.push_back(source.path);
  }
  if (others.empty()) return {};
  return fmt::format("{} was rendered from {}, which this scene does not contain: another scene?",
                     text::printable(viewed.name), text::printable(joined(others, ", ")));
}

/// The server's address goes to standard output. The maps are kept for their cameras alone.
int serve(const ViewArguments& arguments, std::vector<ViewedMap> maps, const Console& console) {
  SceneOptions options = arguments.reading;
  options.files = {arguments.scene};
  const Scene scene = options.read(console, {.hash = true, .segments = true});
  std::string page;
  with_threads(options.threads, [&] {
    view::write_page(maps, view::Questions::probes, [&](std::string_view part) { page += part; });
  });
  std::vector<Camera> cameras;
  std::vector<std::string> notes;
  for (const ViewedMap& viewed : maps) {
    cameras.push_back(*viewed.camera);
    notes.push_back(note_of_another_scene(viewed, scene));
    if (!notes.back().empty()) console.warn(notes.back());
  }
  maps.clear();
  const auto answer = [&](std::uint32_t map, std::uint32_t x, std::uint32_t y) -> std::string {
    if (map >= cameras.size() || x >= cameras[map].width || y >= cameras[map].height) return {};
    const Camera& camera = cameras[map];
    const std::string text = with_threads(options.threads, [&] {
      return as_text({scene, camera, x, y, probe(scene, camera, x, y)});
    });
    return notes[map].empty() ? text : "note: " + notes[map] + "\n\n" + text;
  };
  ProbeServer server(std::move(page), answer);
  print(server.address() + "\n");
  if (arguments.open) open_in_browser(server.address(), console);
  server.run();
  return done;
}

/// Whether the camera has a table of directions that is only named.
bool names_table(const Camera& camera) {
  return camera.projection.lens && camera.projection.lens->directions &&
         !camera.projection.lens->directions->is_read();
}

int run_view(const ViewArguments& arguments, const Console& console) {
  if (arguments.serve != !arguments.scene.empty()) {
    throw UsageError(arguments.serve
                         ? "--serve needs --scene, the scene that the maps show"
                         : "--scene needs --serve: a server answers questions about the scene");
  }
  for (const std::string& map : arguments.maps) refuse_folder_of("report.html", map);
  std::vector<ViewedMap> maps = read_maps(arguments, console);
  if (!arguments.serve) return write_and_open(arguments, maps, console);
  for (const ViewedMap& viewed : maps) {
    if (!viewed.camera) {
      throw UsageError("--serve: " + viewed.name +
                       " carries no camera, so that no pixel of it can be probed; give it with "
                       "--camera");
    }
    if (names_table(*viewed.camera)) {
      throw UsageError("--serve: " + viewed.name +
                       " names the table of its camera and does not carry it; ask 'fathom probe "
                       "--camera' instead");
    }
  }
  return serve(arguments, std::move(maps), console);
}

/// `fathom view`: maps in a page for a browser.
void add_view(Command& program) {
  const auto arguments = std::make_shared<ViewArguments>();
  Command& command =
      program.command("view", description_of_companion("view"),
                      "  fathom view spot.exr\n"
                      "  fathom view spot.exr -o spot.html\n"
                      "  fathom view exact.exr other.exr\n"
                      "  fathom view spot.exr --scene spot.obj --serve --open\n"
                      "  fathom view vtk.npy --camera camera.json --scene spot.obj --serve --open");
  command
      .arguments("MAP", arguments->maps,
                 "Maps to look at (" + names_of_readable_maps() +
                     "), also deep EXR, or report.html of 'fathom validate'; - is standard input")
      .required();
  const Option output =
      add_output_option(command, "FILE", into(arguments->output, parse_page_name),
                        "Write the page here, an HTML file that needs no other file, and open no "
                        "browser (default: a temporary file, which a browser opens)");
  command.flag("--open", arguments->open, "Open the page in the browser even with -o or --serve");
  command.option("--camera", "FILE", arguments->camera,
                 "Camera file (JSON), or a map, which contains its camera, instead of the cameras "
                 "in the maps: a single camera for all maps, a camera for each map, in order, or "
                 "cameras that are named like the maps");
  command.option("--scene", "FILE", arguments->scene,
                 "Scene that the maps show, a mesh or a scene file; needs --serve");
  command
      .flag("--serve", arguments->serve,
            "Serve the page at a secret address of this machine, which is printed, until "
            "interrupted: a click on a pixel shows the output of 'fathom probe'")
      .excludes(output);
  arguments->reading.add_reading_to(command);
  command.runs([arguments](const Console& console) { return run_view(*arguments, console); });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "view", fathom::app::add_view);
}
