// fathom doctor SCENE… --camera FILE --depth FILES

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/doctor/corrected_folder.h"
#include "apps/doctor/data_set.h"
#include "apps/doctor/diagnosis.h"
#include "apps/options/camera_options.h"
#include "apps/options/map_arguments.h"
#include "apps/options/output_arguments.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using doctor::DataSet;
using doctor::Diagnosis;
using doctor::View;

struct DoctorArguments {
  SceneOptions scene;
  std::string camera, output;
  std::vector<std::string> depth;
  std::optional<double> png_scale;
  std::uint32_t images = 8;
  bool overwrites = false, json = false;
};

/// A file for each camera, or a camera for each file.
struct Inputs {
  std::vector<Camera> cameras;
  std::vector<std::string> files;
};

bool is_pattern(const std::vector<std::string>& depth) {
  return depth.size() == 1 && depth.front().find('{') != std::string::npos;
}

Inputs inputs_of(const DoctorArguments& arguments, const Console& console) {
  Inputs inputs{read_cameras_with_lenses(arguments.camera, arguments.scene.limits, console), {}};
  if (is_pattern(arguments.depth)) {
    inputs.files = names_of_outputs("--depth", arguments.depth.front(), inputs.cameras);
  } else {
    inputs.files = arguments.depth;
    inputs.cameras = cameras_of_maps(inputs.files, inputs.cameras);
  }
  return inputs;
}

View read_view(const Inputs& inputs, std::size_t i, const DoctorArguments& arguments) {
  constexpr double millimetres = 1000;
  DepthMap map = read_map_argument(inputs.files[i]);
  const double scale = arguments.png_scale.value_or(map.png_scale.value_or(millimetres));
  return {inputs.cameras[i], doctor::depth_image(std::move(map), inputs.files[i], scale)};
}

/// At most this many of `count`, at equal distances.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t size = std::min(count, most);
  for (std::size_t i = 0; i < size; ++i) chosen.push_back(i * count / size);
  return chosen;
}

/// Corrects the depth images of all cameras, also of images that were not looked at.
void write_corrected(const Inputs& inputs, const Diagnosis& found, const DoctorArguments& arguments,
                     CorrectedFolder& folder) {
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < inputs.cameras.size(); ++i) {
    const View view = read_view(inputs, i, arguments);
    cameras.push_back(doctor::corrected_camera(view, found));
    folder.write_depth(i, doctor::corrected_map(view, found));
  }
  folder.finish(cameras);
}

std::string parse_folder(const std::string& text) {
  if (text == "-") throw UsageError("corrected files go to a folder; name one in place of '-'");
  return text;
}

/// A word of a command for a shell.
std::string quoted(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-./,:=+%@").find(char(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The command that corrects the faults: this one, with -o.
std::string cure_of(const DoctorArguments& arguments) {
  std::string text = "fathom doctor";
  for (const std::string& file : arguments.scene.files) text += " " + quoted(file);
  text += " --camera " + quoted(arguments.camera) + " --depth";
  for (const std::string& file : arguments.depth) text += " " + quoted(file);
  if (arguments.png_scale) text += fmt::format(" --png-scale {}", *arguments.png_scale);
  return text + " -o corrected";
}

int run_doctor(const DoctorArguments& arguments, const Console& console) {
  const Inputs inputs = inputs_of(arguments, console);
  for (const std::string& file : inputs.files) note_input(file);
  const Scene scene = arguments.scene.read(console);
  std::optional<CorrectedFolder> folder;
  if (!arguments.output.empty())
    folder.emplace(arguments.output, inputs.cameras, arguments.overwrites, console);
  std::vector<View> views;
  for (const std::size_t i : spread(inputs.files.size(), arguments.images))
    views.push_back(read_view(inputs, i, arguments));
  doctor::require_depths(views);
  DataSet data(scene, std::move(views), arguments.scene.threads);
  Diagnosis found;
  {
    Progress progress(console, "comparing");
    found = doctor::diagnose(data, progress.reporter());
  }
  const std::string cure = cure_of(arguments);
  if (folder) {
    if (found.verdict != doctor::Verdict::faulty && found.verdict != doctor::Verdict::well)
      throw InputError(
          fmt::format("{}: not written: the faults are not certain; without -o the "
                      "command shows the explanations",
                      arguments.output));
    write_corrected(inputs, found, arguments, *folder);
  }
  print(arguments.json ? doctor::to_json(found, cure) : doctor::to_text(found, cure));
  return found.verdict == doctor::Verdict::well ? done : answer_is_no;
}

}  // namespace

void add_doctor(Command& program) {
  const auto arguments = std::make_shared<DoctorArguments>();
  Command& command = program.command(
      "doctor", description_of_companion("doctor"),
      "  fathom doctor room.ply --camera cameras.json --depth 'depth/{stem}.png'\n"
      "  fathom doctor room.ply --camera camera.json --depth a.png --png-scale 5000\n"
      "  fathom doctor room.ply --camera cameras.json --depth 'depth/{stem}.png' \\\n"
      "    -o corrected\n"
      "\nFinds axes, matrices, units, image sizes, mirrored images, lenses, ray distances, half "
      "pixels, clipped and truncated codes, and two such faults together, by rendering the mesh as "
      "each would have it.\n"
      "Exit status 1 unless all is well; see doctor.md in the documentation.");
  arguments->scene.add_to(command);
  command
      .option("--camera", "FILE", arguments->camera, "Camera file with the cameras of the images")
      .required();
  command
      .option_with_values("--depth", "FILE", arguments->depth,
                          "Depth images, one for each camera or named like the cameras; or a "
                          "pattern: {index:04} is the camera's number, {name} its name, {stem} its "
                          "name without folders and suffix")
      .required();
  command.option("--png-scale", "N", into(arguments->png_scale, parse_scale),
                 "Codes per unit of a PNG (default: as in the file, or 1000)");
  command.option("--images", "N", into(arguments->images, parse_positive),
                 "Number of images to read and look at, at equal distances (default 8)");
  command.flag("--json", arguments->json, "Print JSON");
  add_output_option(command, "DIR", into(arguments->output, parse_folder),
                    "Write cameras.json and depth/*.exr without the faults that were found to this "
                    "folder, and a list of these files, so that the next run may replace them");
  command.flag("--overwrite", arguments->overwrites,
               "Overwrite files in the folder that fathom has not made");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_doctor(*arguments, console); });
}

}  // namespace fathom::app
