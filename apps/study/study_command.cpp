// fathom study NAME --out DIR

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <list>
#include <memory>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "validation/studies/study.h"

namespace fathom::app {
namespace {

using studies::Study;
using studies::StudyFile;

struct StudyArguments {
  std::string name, out, near, far, samples, separation, camera;
  std::vector<std::string> scene;
  bool list = false;
};

std::string list_of_studies() {
  std::string text;
  for (const Study& study : studies::all_studies()) {
    text += fmt::format("{:<18} {}\n", study.name, study.description);
  }
  return text;
}

/// The scene with its camera, or with one that frames it in 640×360 pixels.
studies::SceneView read_view(const StudyArguments& arguments, const Console& console) {
  Warnings warnings;
  std::vector<std::filesystem::path> files(arguments.scene.begin(), arguments.scene.end());
  for (const auto& file : files) note_input(file);
  studies::SceneView view{files.front().filename().string(), read_scene(files, {}, warnings), {}};
  for (const std::string& warning : warnings) console.warn(warning);
  if (triangle_count(view.scene) == 0) {
    throw InputError(files.front().string() + ": the scene has no triangle");
  }
  if (arguments.camera.empty()) {
    Lens lens;
    lens.width = 640;
    lens.height = 360;
    view.camera = frame_scene(view.scene, {}, lens);
    return view;
  }
  note_input(arguments.camera);
  const std::vector<Camera> cameras = read_cameras(arguments.camera);
  if (cameras.size() != 1) {
    throw InputError(
        fmt::format("{}: {} cameras; a study looks through one", arguments.camera, cameras.size()));
  }
  if (const auto fault = find_fault(cameras[0])) {
    throw InputError(arguments.camera + ": " + *fault);
  }
  view.camera = cameras[0];
  return view;
}

studies::StudyOptions options_of(const StudyArguments& arguments) {
  studies::StudyOptions options;
  if (!arguments.near.empty()) options.near = parse_number("--near", arguments.near);
  if (!arguments.far.empty()) options.far = parse_number("--far", arguments.far);
  if (!arguments.samples.empty()) options.samples = parse_count("--samples", arguments.samples, 2);
  if (!arguments.separation.empty()) {
    options.separation = parse_number("--separation", arguments.separation);
  }
  return options;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw OutputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                  error ? error.message() : "it is a file"));
  }
}

/// All files are written before the first is put in its place.
void write_files(const std::filesystem::path& folder, const std::vector<StudyFile>& files) {
  std::list<OutputFile> outputs;
  for (const StudyFile& file : files) {
    outputs.emplace_back(folder / file.name);
    outputs.back().write(file.content);
  }
  for (OutputFile& output : outputs) output.commit();
}

/// Shows the share that is done, after the first second.
class Percentage {
 public:
  explicit Percentage(bool shown) : shown_(shown) {}
  void operator()(double share) {
    if (!shown_ || std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
    std::fprintf(stderr, "\r%3d %%%s", static_cast<int>(100 * share),
                 share >= 1 ? "\r     \r" : "");
  }

 private:
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int run_study(const StudyArguments& arguments, const Console& console) {
  if (arguments.list) {
    print(list_of_studies());
    return done;
  }
  if (arguments.name.empty()) throw UsageError("NAME is missing: 'fathom study --list' lists them");
  const Study& study = studies::study_named(arguments.name);
  if (arguments.out.empty()) throw UsageError("--out DIR is missing: where the files go");
  studies::StudyOptions options = options_of(arguments);
  if (!arguments.scene.empty() && !study.takes_scene) {
    throw UsageError(fmt::format("the study {} takes no --scene", study.name));
  }
  if (arguments.scene.empty() && !arguments.camera.empty()) {
    throw UsageError("--camera belongs to --scene");
  }
  if (!arguments.scene.empty()) options.scene = read_view(arguments, console);
  Percentage percentage(console.shows_progress());
  const std::vector<StudyFile> files =
      study.run(options, [&percentage](double share) { percentage(share); });
  make_folder(arguments.out);
  write_files(arguments.out, files);
  return done;
}

}  // namespace

void add_study(Program& program) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = program.add_command(
      "study", "Precision of depth buffers, measured: figures, plots and a page that explains them",
      "  fathom study --list\n"
      "  fathom study depth-resolution --near 0.1 --far 1000 --out resolution\n"
      "  fathom study indistinguishable --out reed\n"
      "  fathom study mitigation --scene data/meshes/spot.obj --near 0.001 --out cures");
  command->add_option("NAME", arguments->name, "The study");
  command->add_option("--out", arguments->out,
                      "Folder for CSV, PNG, SVG, summary.json, index.html");
  command->add_option(
      "--scene", arguments->scene,
      "Meshes or scene files to look at, for antialiasing, mitigation, subpixel and "
      "z-fighting; without it they have scenes of their own");
  command->add_option("--camera", arguments->camera,
                      "Camera file (JSON) for --scene; without it, one that frames the scene");
  command->add_option("--near", arguments->near, "Least depth");
  command->add_option("--far", arguments->far, "Greatest depth");
  command->add_option("--samples", arguments->samples, "Number of depths");
  command->add_option("--separation", arguments->separation,
                      "Of two surfaces along the view, for z-fighting");
  command->add_flag("--list", arguments->list, "List the studies");
  command->callback([&program, arguments] {
    program.run = [&program, arguments] { return run_study(*arguments, program.console); };
  });
}

}  // namespace fathom::app
