#include "fathom/camera/posed_cameras.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace camera;

namespace {

constexpr const char* pose_suffix = ".pose.txt";

}  // namespace

ImportedCamera camera::parse_7scenes(const NamedText& pose, const std::string& frame,
                                     const GivenLens& given) {
  // The intrinsics with which KinectFusion made the poses; the camera was not calibrated.
  const GivenLens kinect{.width = 640, .height = 480, .K = intrinsic_matrix(585, 585, 320, 240)};
  return imported_camera(frame, pose.name, [&](ImportedCamera& one) {
    one.camera = lens_of(given, kinect, "K");
    one = placed(one, {frame, parse_pose(pose.text, pose.name)}, PoseDirection::camera_to_world,
                 CameraAxes::opencv, pose.name);
  });
}

std::vector<ImportedCamera> import_7scenes(const std::filesystem::path& folder,
                                           const GivenLens& given) {
  const StandardArithmetic standard;
  std::vector<ImportedCamera> cameras;
  for (const auto& file : files_of(folder, pose_suffix)) {
    std::string frame = file.filename().string();
    frame.resize(frame.size() - std::string_view(pose_suffix).size());
    cameras.push_back(parse_7scenes({files::InputFile(file).text(), file.string()}, frame, given));
  }
  return cameras;
}

}  // namespace fathom
