#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/values.h"
#include "fathom/camera/data_set_cameras.h"

namespace fathom::app {

struct ImportArguments {
  std::string input, output = "-";
  CameraChoice choice;
  std::optional<Size> size;
  bool list = false;

  // Data that some kinds of files lack.

  /// "fx,fy,cx,cy", a file, or the name of a lens.
  std::string K;
  std::optional<double> pixel_centre;
  std::optional<PoseDirection> direction;
  std::optional<CameraAxes> axes;
  /// Files beside INPUT: a list of images, poses, the poses of cameras on a vehicle.
  std::string images, poses, rig;
  bool camera_to_world = false;
  std::optional<std::uint32_t> number;
  ScanNetStream stream = ScanNetStream::depth;
};

/// One of the kinds of files that cameras are imported from.
struct ImportSource {
  const char* name;
  const char* description;
  /// What INPUT is.
  const char* input;
  const char* example;
  /// Declares the options of this source; they write to `arguments`.
  void (*declare)(Command& command, ImportArguments& arguments);
  /// Fails    as camera_import.h; UsageError if an option is missing.
  std::vector<ImportedCamera> (*read)(const ImportArguments& arguments, Warnings& warnings);
  /// Whether a lens can be ignored; fisheyes have no pinhole part.
  bool has_pinholes = true;
};

/// --size, for sources whose files may not have one.
void add_size_option(Command& command, ImportArguments& arguments);
/// --pixel-centre; `otherwise` ends its help.
void add_pixel_centre(Command& command, ImportArguments& arguments, const std::string& otherwise);
/// The values that --size, --K and --pixel-centre give.
/// Fails    UsageError if --K is not fx,fy,cx,cy.
GivenLens given_lens(const ImportArguments& arguments);
/// Poses as text or in an array of NumPy: .txt, .npy, .npz or .npz:ARRAY.
std::vector<NamedPose> read_poses_argument(const std::string& file);
/// --ignore-distortion.
void add_distortion_option(Command& command, CameraChoice& choice);

/// Files that programs write.
std::vector<ImportSource> program_sources();
/// Layouts of data sets, and matrices of any origin.
std::vector<ImportSource> data_set_sources();

/// Calibrations of a camera.
std::vector<ImportSource> calibration_sources();

/// `fathom camera import colmap | nerf | …`
void add_import(Command& camera);

}  // namespace fathom::app
