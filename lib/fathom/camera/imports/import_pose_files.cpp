#include <algorithm>
#include <charconv>
#include <cmath>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;

namespace fs = std::filesystem;

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

namespace {

/// The number that a name is; nullopt if the name is not a number.
std::optional<std::uint64_t> number_in(const std::string& name) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return number;
}

/// The frames' files by their numbers, which may have no leading zeros.
std::vector<std::pair<std::uint64_t, fs::path>> numbered_files(const fs::path& folder) {
  std::vector<std::pair<std::uint64_t, fs::path>> files;
  for (const fs::path& file : files_of(folder, ".txt"))
    if (const auto number = number_in(file.stem().string())) files.emplace_back(*number, file);
  if (files.empty()) throw InputError(folder.string() + ": has no file N.txt of a frame");
  std::sort(files.begin(), files.end());
  return files;
}

bool is_finite(const Pose& pose) {
  return std::ranges::all_of(pose, [](const auto& row) {
    return std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
  });
}

Pose pose_of_rows(const text::JsonValue& matrix) {
  std::vector<double> numbers;
  for (const text::JsonValue& row : matrix.elements()) {
    const std::vector<double> own = row.numbers(4);
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  return pose_of_numbers(numbers, matrix.where());
}

IntrinsicMatrix intrinsics_of_rows(const text::JsonValue& matrix) {
  IntrinsicMatrix K;
  std::size_t i = 0;
  for (const text::JsonValue& row : matrix.elements(3))
    for (const double entry : row.numbers(3)) K[i++] = entry;
  return K;
}

}  // namespace

IntrinsicMatrix camera::parse_scannet_intrinsics(const NamedText& file) {
  const Pose matrix = parse_pose(file.text, file.name);
  IntrinsicMatrix K;
  for (std::size_t i = 0; i < 9; ++i) K[i] = matrix[i / 3][i % 3];
  return K;
}

ImportedCamera camera::parse_scannet(const NamedText& pose, const std::string& frame,
                                     const Camera& lens) {
  return imported_camera(frame, pose.name, [&](ImportedCamera& one) {
    one.camera = lens;
    const Pose matrix = parse_pose(pose.text, pose.name);
    if (!is_finite(matrix)) {
      one.absence = pose.name + ": the frame was not tracked: its pose is not finite";
      return;
    }
    one =
        placed(one, {frame, matrix}, PoseDirection::camera_to_world, CameraAxes::opencv, pose.name);
  });
}

std::vector<ImportedCamera> import_scannet(const fs::path& folder, ScanNetStream stream,
                                           const GivenLens& given) {
  const StandardArithmetic standard;
  const bool depth = stream == ScanNetStream::depth;
  GivenLens scannet{.width = depth ? 640U : 1296U, .height = depth ? 480U : 968U};
  const fs::path intrinsics =
      folder / "intrinsic" / (depth ? "intrinsic_depth.txt" : "intrinsic_color.txt");
  if (!given.K) {
    const files::InputFile file(intrinsics);
    scannet.K = parse_scannet_intrinsics({file.text(), intrinsics.string()});
  }
  const Camera lens = lens_of(given, scannet, given.K ? "K" : intrinsics.string());
  std::vector<ImportedCamera> cameras;
  for (const auto& [number, file] : numbered_files(folder / "pose"))
    cameras.push_back(parse_scannet({files::InputFile(file).text(), file.string()},
                                    std::to_string(number), lens));
  require_different_names(cameras, (folder / "pose").string());
  return cameras;
}

std::vector<ImportedCamera> camera::parse_scannetpp(const NamedText& file, const GivenLens& given) {
  const text::JsonDocument document(file.text, file.name);
  const text::JsonValue root = document.root();
  const GivenLens video{.width = 1920, .height = 1440};
  std::vector<ImportedCamera> cameras;
  for (const auto& [frame, entry] : root.members()) {
    const text::JsonValue& own = entry;
    const std::string& name = frame;
    cameras.push_back(imported_camera(name, own.where(), [&](ImportedCamera& one) {
      GivenLens iphone = video;
      if (!given.K) iphone.K = intrinsics_of_rows(own.at("intrinsic"));
      one.camera = lens_of(given, iphone, own.where());
      const text::JsonValue matrix = own.at("aligned_pose");
      one = placed(one, {name, pose_of_rows(matrix)}, PoseDirection::camera_to_world,
                   CameraAxes::opencv, matrix.where());
    }));
  }
  if (cameras.empty()) root.fail("there is no frame");
  return cameras;
}

std::vector<ImportedCamera> import_scannetpp(const fs::path& file, const GivenLens& given) {
  const StandardArithmetic standard;
  const files::InputFile input(file);
  return parse_scannetpp({input.text(), file.string()}, given);
}

}  // namespace fathom
