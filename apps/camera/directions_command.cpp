// fathom camera directions

#include "apps/camera/directions_command.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>

#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera_directions.h"
#include "fathom/failures/errors.h"
#include "fathom/image/directions.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

struct DirectionsArguments {
  std::string camera, output;
  ReadLimits limits;
};

bool is_csv(const std::string& file) {
  return std::filesystem::path(file).extension() == ".csv";
}

std::string parse_table_name(const std::string& text) {
  const std::optional<MapFormat> format = map_format_of(text);
  const bool is_map_of_vectors =
      format == MapFormat::npy || format == MapFormat::npz || format == MapFormat::exr;
  if (is_csv(text) || is_map_of_vectors) return text;
  throw UsageError("'" + text + "' does not end in .npy, .npz, .exr or .csv");
}

Camera read_one_camera(const DirectionsArguments& arguments, const Console& console) {
  const std::vector<Camera> cameras =
      read_cameras_with_lenses(arguments.camera, arguments.limits, console);
  if (cameras.size() == 1) return cameras.front();
  throw InputError(fmt::format("{}: a path of {} cameras, expected a single camera",
                               arguments.camera, cameras.size()));
}

void write_table(const std::string& file, const DirectionTable& table) {
  OutputFile output(file);
  if (is_csv(file)) {
    output.write(csv_of_directions(table));
  } else {
    const MapFormat format = require_map_format(file);
    const bool is_exr = format == MapFormat::exr;
    WriteOptions options;
    options.channel = is_exr ? "" : "directions";
    const DepthMap map =
        map_of_directions(table, is_exr ? DirectionChannels::exr : DirectionChannels::array);
    output.write([&](const auto& path) { write_map(map, path, format, options); });
  }
  output.commit();
}

// EXR has no binary64.
int run_directions(const DirectionsArguments& arguments, const Console& console) {
  const Camera camera = read_one_camera(arguments, console);
  const auto rounding = map_format_of(arguments.output) == MapFormat::exr
                            ? DirectionRounding::binary32
                            : DirectionRounding::binary64;
  Progress progress(console, "finding directions");
  write_table(arguments.output, directions_of(camera, rounding, progress.reporter()));
  return done;
}

}  // namespace

void add_directions(Command& camera) {
  const auto arguments = std::make_shared<DirectionsArguments>();
  Command& command = camera.command(
      "directions", "Write the directions that the pixels of a camera see",
      "  fathom camera directions camera.json -o rays.npy\n"
      "\nThe directions are in the camera frame, one for each pixel: x right, y down, z forward. "
      "The component that is greatest in magnitude is 1 or -1. Each component is rounded once, to "
      "binary64, or to binary32 for EXR. A pixel without a ray has 0,0,0. A camera of the model "
      "TABLE takes such a file as its \"directions\".");
  command.argument("CAMERA", arguments->camera, "Camera file, or a map, which contains its camera")
      .required();
  arguments->limits.add_confine_to(command);
  add_output_option(command, "FILE", into(arguments->output, parse_table_name),
                    "Write the table here; the suffix chooses the format: .npy or .npz (height x "
                    "width x 3), .exr (channels d.X, d.Y, d.Z) or .csv (a line x,y,z for each "
                    "pixel)")
      .required();
  command.runs([arguments](const Console& console) { return run_directions(*arguments, console); });
}

}  // namespace fathom::app
