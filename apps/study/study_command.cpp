// fathom study NAME -o DIR

#include <fmt/core.h>

#include <filesystem>
#include <list>
#include <memory>

#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

using studies::Study;
using studies::StudyFile;

struct StudyArguments {
  std::string name, out, camera;
  std::vector<std::string> scene;
  ReadLimits limits;
  /// All but the scene, which is read when everything else is in order.
  studies::StudyOptions options;
  bool list = false, no_plots = false;
};

std::string list_of_studies() {
  std::string text;
  for (const Study& study : studies::all_studies()) {
    text += fmt::format("{:<18} {}\n", study.name, study.description);
  }
  return text;
}

/// The only camera of the file. The study `lens` refuses lenses itself, if it must.
Camera camera_of_study(const StudyArguments& arguments, const Console& console) {
  const std::string& file = arguments.camera;
  const std::vector<Camera> cameras =
      arguments.name == "lens" ? read_cameras_with_lenses(file, arguments.limits, console)
                               : read_cameras_without_lens(file, console);
  if (cameras.size() != 1) {
    throw InputError(
        fmt::format("{}: {} cameras; a study takes a single one", file, cameras.size()));
  }
  return cameras[0];
}

/// The scene with its camera, or with one that frames it in 640×360 pixels.
studies::SceneView read_view(const StudyArguments& arguments, const Console& console) {
  Warnings warnings;
  const std::vector<std::filesystem::path> files(arguments.scene.begin(), arguments.scene.end());
  std::string names;
  for (const auto& file : files) {
    note_input(file);
    names += (names.empty() ? "" : " ") + file.filename().string();
  }
  studies::SceneView view{names, read_scene(files, arguments.limits.read_options(), warnings), {}};
  console.warn(warnings);
  if (triangle_count(view.scene) == 0) {
    throw InputError(files.front().string() + ": the scene has no triangle");
  }
  view.camera = arguments.camera.empty()
                    ? frame_scene(view.scene, {}, {.width = 640, .height = 360})
                    : camera_of_study(arguments, console);
  return view;
}

/// All files are written before the first is put in its place.
void write_files(const std::filesystem::path& folder, const std::vector<StudyFile>& files) {
  std::list<OutputFile> outputs;
  for (const StudyFile& file : files) {
    outputs.emplace_back(folder / file.name);
    outputs.back().write(file.content);
  }
  std::vector<OutputFile*> together;
  for (OutputFile& output : outputs) together.push_back(&output);
  OutputFile::commit_together(together);
}

/// The study that the arguments name. Fails with UsageError where they do not fit it.
const Study& study_of(const StudyArguments& arguments) {
  if (arguments.name.empty()) throw UsageError("NAME is missing: 'fathom study --list' lists them");
  const Study& study = studies::study_named(arguments.name);
  if (arguments.out.empty()) throw UsageError("-o DIR is missing: where the files go");
  if (!arguments.scene.empty() && !study.takes_scene) {
    throw UsageError(fmt::format("the study {} takes no --scene", study.name));
  }
  if (arguments.scene.empty() && !arguments.camera.empty()) {
    throw UsageError("--camera belongs to --scene");
  }
  return study;
}

std::vector<StudyFile> run_with_progress(const Study& study, const studies::StudyOptions& options,
                                         const Console& console) {
  Progress progress(console, study.name);
  const auto report = progress.reporter();
  return study.run(options, [&report](double share) {
    if (report) report(share);
  });
}

int run_study(const StudyArguments& arguments, const Console& console) {
  if (arguments.list) {
    if (!arguments.name.empty() || !arguments.out.empty())
      throw UsageError("--list lists all studies; leave out NAME and --output");
    print(list_of_studies());
    return done;
  }
  const Study& study = study_of(arguments);
  studies::StudyOptions options = arguments.options;
  options.plots = !arguments.no_plots;
  if (!arguments.scene.empty()) options.scene = read_view(arguments, console);
  const std::vector<StudyFile> files = run_with_progress(study, options, console);
  make_folder(arguments.out);
  write_files(arguments.out, files);
  if (console.shows_progress())
    console.note((std::filesystem::path(arguments.out) / "index.html").string() + " is the page");
  return done;
}

std::string parse_study(const std::string& text) {
  return std::string(studies::study_named(text).name);
}

std::uint32_t parse_samples(const std::string& text) {
  return parse_count_from(2, text);
}

void add_study(Command& program) {
  auto arguments = std::make_shared<StudyArguments>();
  studies::StudyOptions& options = arguments->options;
  Command& command =
      program.command("study", description_of_companion("study"),
                      "  fathom study --list\n"
                      "  fathom study depth-resolution --near 0.1 --far 1000 -o resolution\n"
                      "  fathom study indistinguishable -o reed\n"
                      "  fathom study mitigation --scene spot.obj --near 0.001 -o cures");
  command.argument("NAME", into(arguments->name, parse_study),
                   "Name of the study; --list shows all names");
  add_output_option(command, "DIR", arguments->out,
                    "Folder for CSV, PNG, SVG, summary.json, index.html");
  command.option_with_values(
      "--scene", "FILE", arguments->scene,
      "Meshes or scene files to study, for antialiasing, hidden-surface, lens, mitigation, "
      "subpixel and z-fighting (default: the study's own scene)");
  arguments->limits.add_to(command);
  command.option("--camera", "FILE", arguments->camera,
                 "Camera file (JSON) for --scene (default: a camera that frames the scene)");
  command.option("--near", "D", into(options.near, parse_number),
                 "Least depth (default: the study's)");
  command.option("--far", "D", into(options.far, parse_number),
                 "Greatest depth (default: the study's)");
  command.option("--samples", "N", into(options.samples, parse_samples),
                 "Number of depths (default: the study's)");
  command.option("--separation", "D", into(options.separation, parse_number),
                 "Separation of the two surfaces along the view, for z-fighting");
  command.flag("--no-plots", arguments->no_plots, "Write no plots, so that gnuplot is not needed");
  command.flag("--list", arguments->list, "List the studies");
  command.runs([arguments](const Console& console) { return run_study(*arguments, console); });
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::companion_main(argc, argv, "study", fathom::app::add_study);
}
