// fathom camera import opencv | ros

#include "apps/camera/import_sources.h"
#include "apps/camera/yaml_text.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/calibration_cameras.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"

namespace fathom::app {
namespace {

using Cameras = std::vector<ImportedCamera>;

void declare_calibration(Command& command, ImportArguments& a) {
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
  command.option("--poses", "FILE", a.poses,
                 "World-to-camera matrices (x right, y down, z forward) as .txt, .npy or .npz: a "
                 "camera for each "
                 "(default: the identity; a calibration has no pose)");
  command.flag("--camera-to-world", a.camera_to_world,
               "The matrices of --poses are camera to world");
}

CalibrationPoses poses_of(const ImportArguments& a) {
  CalibrationPoses given;
  if (a.poses.empty()) {
    if (a.camera_to_world) throw UsageError("--camera-to-world goes with --poses");
    return given;
  }
  given.poses = read_poses_argument(a.poses);
  if (a.camera_to_world) given.direction = PoseDirection::camera_to_world;
  return given;
}

/// Why XML is none of the formats: OpenCV's FileStorage has it, too.
void refuse_xml(std::string_view text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '<')
    throw InputError(file + ": is XML, expected YAML or JSON; write it with FileStorage as .yml");
}

template <class Parse>
Cameras read_calibration(const ImportArguments& a, const Parse& parse) {
  note_input(a.input);
  const files::InputFile file(a.input);
  refuse_xml(file.text(), a.input);
  return parse(json_of_yaml(file.text(), a.input), a.input, given_lens(a), poses_of(a));
}

Cameras read_opencv(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_opencv);
}

Cameras read_ros(const ImportArguments& a, Warnings&) {
  return read_calibration(a, cameras_of_ros);
}

}  // namespace

std::vector<ImportSource> calibration_sources() {
  return {{"opencv", "Import a calibration of OpenCV: FileStorage as YAML or JSON",
           "The file of cv::FileStorage with camera_matrix and distortion_coefficients",
           "  fathom camera import opencv calibration.yml -o camera.json\n"
           "  fathom camera import opencv calibration.yml --poses poses.txt -o cameras.json",
           declare_calibration, read_opencv},
          {"ros", "Import a calibration of ROS: camera_info as YAML",
           "The file of camera_calibration, or a message",
           "  fathom camera import ros ost.yaml -o camera.json", declare_calibration, read_ros}};
}

}  // namespace fathom::app
