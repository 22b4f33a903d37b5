#include "apps/camera/shutter_command.h"

#include <memory>

#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

std::string parse_ray_file(const std::string& text) {
  if (map_format_of(text) == MapFormat::npy) return text;
  throw UsageError("'" + text + "' does not end in .npy");
}

}  // namespace

void add_shutter(Command& camera, const ShutterRun& run) {
  const auto arguments = std::make_shared<ShutterArguments>();
  Command& command = camera.command(
      "shutter", "Write the rays of a moving camera with a rolling shutter",
      "  fathom camera shutter camera.json --poses path.txt --readout 0.03 -o rays.npy\n"
      "  fathom cast room.json --rays rays.npy -o hits.npz\n"
      "\nEach row of the image has its own pose. Ray row*width + column is of the pixel in this "
      "row and column. t of a hit is its planar depth, except with fisheyes, panoramas and tables. "
      "The pose of a row and each number of its rays are rounded once.");
  command.argument("CAMERA", arguments->camera, "Camera file, or a map, which contains its camera")
      .required();
  arguments->limits.add_confine_to(command);
  command
      .option(
          "--poses", "FILE", arguments->poses,
          "Path of the camera, lines `time tx ty tz qx qy qz qw` (seconds), camera to world, if "
          "the pose of CAMERA is the identity. Otherwise the path of what CAMERA is mounted on")
      .required();
  command
      .option("--readout", "SECONDS", into(arguments->readout, parse_number),
              "Time from the top row to the bottom row; negative if the bottom row comes first")
      .required();
  command.option("--start", "SECONDS", into(arguments->start, parse_number),
                 "Time of the top row (default: the first of --poses)");
  add_output_option(command, "FILE", into(arguments->output, parse_ray_file),
                    "Write the rays to this NPY file, as `fathom cast --rays` reads it")
      .required();
  command.runs([arguments, run](const Console& console) { return run(*arguments, console); });
}

}  // namespace fathom::app
