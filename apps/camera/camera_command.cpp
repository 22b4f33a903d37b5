#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/camera/import_sources.h"
#include "apps/camera/shutter_command.h"
#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera_directions.h"
#include "fathom/failures/errors.h"
#include "fathom/image/directions.h"
#include "fathom/image/map_files.h"
#include "fathom/scene/framing.h"

namespace fathom::app {
namespace {

// fathom camera directions

struct DirectionsArguments {
  std::string camera, output;
  ReadLimits limits;
};

bool is_csv(const std::string& file) {
  return std::filesystem::path(file).extension() == ".csv";
}

std::string parse_table_name(const std::string& text) {
  const std::optional<MapFormat> format = map_format_of(text);
  if (is_csv(text) || (format && holds_any_channel(*format))) return text;
  throw UsageError("'" + text + "' does not end in .npy, .npz, .exr or .csv");
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
  const Camera camera = read_camera_with_lens(arguments.camera, arguments.limits, console);
  const auto rounding = map_format_of(arguments.output) == MapFormat::exr
                            ? DirectionRounding::binary32
                            : DirectionRounding::binary64;
  Progress progress(console, "finding directions");
  write_table(arguments.output, directions_of(camera, rounding, progress.reporter()));
  return done;
}

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

// fathom camera look-at

struct LookAtArguments {
  Vector3 eye{}, target{}, up{0, 1, 0};
  LensChoice lens;
  DistortionOptions distortion;
  std::string output = "-";
};

int run_look_at(const LookAtArguments& arguments) {
  const Camera camera = look_at(arguments.eye, arguments.target, arguments.up,
                                arguments.distortion.applied(arguments.lens));
  write_text(arguments.output, to_json(camera) + "\n");
  return done;
}

void add_look_at(Command& camera) {
  const auto arguments = std::make_shared<LookAtArguments>();
  Command& command =
      camera.command("look-at", "Make a camera at a point, looking at another point",
                     "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
                     "  fathom camera look-at --eye 0,0,5 --orthographic 2 --size 512x512\n"
                     "  fathom camera look-at --eye 0,0,5 --model RADIAL --distortion "
                     "-0.2,0.1");
  command
      .option("--eye", "X,Y,Z", into(arguments->eye, parse_vector), "Position of the camera, X,Y,Z")
      .required();
  command.option("--target", "X,Y,Z", into(arguments->target, parse_vector),
                 "Point that the camera looks at, X,Y,Z (default 0,0,0)");
  add_up_option(command, arguments->up);
  add_lens_options(command, arguments->lens);
  arguments->distortion.add_to(command);
  add_range_options(command, arguments->lens);
  add_output_option(command, "FILE", arguments->output,
                    "Write the camera file here (default: standard output)");
  command.runs([arguments](const Console&) { return run_look_at(*arguments); });
}

// fathom camera orbit

struct OrbitArguments {
  SceneOptions scene;
  std::uint32_t views = 0;
  View first;
  std::optional<Vector3> centre;
  std::optional<double> distance;
  LensChoice lens;
  DistortionOptions distortion;
  std::string output = "-";
};

std::vector<Camera> orbit_cameras(const OrbitArguments& a, const Console& console) {
  const LensChoice lens = a.distortion.applied(a.lens);
  if (a.scene.files.empty()) {
    if (!a.distance) throw UsageError("orbit needs a SCENE to frame, or --distance");
    return orbit(a.first, a.views, a.centre.value_or(Vector3{}), *a.distance, lens);
  }
  if (a.distance || a.centre) {
    throw UsageError("--centre and --distance do not go with a SCENE, which decides them");
  }
  const Scene scene = a.scene.read(console);
  if (triangle_count(scene) == 0) {
    throw InputError(a.scene.files[0] + ": no triangle; expected something to frame");
  }
  return orbit_scene(a.first, a.views, scene, lens);
}

int run_orbit(const OrbitArguments& arguments, const Console& console) {
  write_text(arguments.output, to_json(orbit_cameras(arguments, console)) + "\n");
  return done;
}

void add_orbit(Command& camera) {
  const auto arguments = std::make_shared<OrbitArguments>();
  Command& command = camera.command(
      "orbit", "Make a camera path around a scene or a point",
      "  fathom camera orbit spot.obj --views 12 -o path.json\n"
      "  fathom render spot.obj --camera path.json -o 'maps/{index:04}.exr'\n"
      "  fathom camera orbit --views 36 --centre 0,0,1 --distance 4 --view 0,30 --up z");
  command.arguments("SCENE", arguments->scene.files, "Meshes and scene files to frame");
  arguments->scene.add_reading_to(command);
  command.option("--views", "N", into(arguments->views, parse_positive), "Number of cameras")
      .required();
  add_view_options(command, arguments->first);
  command.option("--centre", "X,Y,Z", into(arguments->centre, parse_vector),
                 "Point that the cameras look at, X,Y,Z (default 0,0,0)");
  command.option("--distance", "D", into(arguments->distance, parse_number),
                 "Distance of the eye from the centre");
  add_lens_options(command, arguments->lens);
  arguments->distortion.add_to(command);
  add_range_options(command, arguments->lens);
  add_output_option(command, "FILE", arguments->output,
                    "Write the camera file here (default: standard output)");
  command.runs([arguments](const Console& console) { return run_orbit(*arguments, console); });
}

}  // namespace

void add_camera(Command& program, const ShutterRun& shutter) {
  Command& family =
      program.command("camera", "Make or import a camera file, or write its rays",
                      "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
                      "  fathom camera orbit spot.obj --views 12 -o path.json\n"
                      "  fathom camera import colmap sparse/0 -o cameras.json\n"
                      "  fathom camera directions camera.json -o directions.npy\n"
                      "  fathom camera shutter camera.json --poses path.txt --readout 0.03 -o "
                      "rays.npy\n"
                      "\nNumbers are rounded to binary64 when they are written; the written "
                      "numbers define the camera.\n"
                      "Keys of camera files: camera-files.md in the documentation.");
  family.requires_command();
  add_look_at(family);
  add_orbit(family);
  add_directions(family);
  add_shutter(family, shutter);
  add_import(family);
}

}  // namespace fathom::app
