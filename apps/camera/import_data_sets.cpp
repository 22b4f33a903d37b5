#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "apps/camera/import_sources.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"

// fathom camera import matrices | tum | 7scenes | scannet | scannetpp | replica | kitti
namespace fathom::app {
namespace {

using Cameras = std::vector<ImportedCamera>;

/// An array of two dimensions is an image of one part, one of three an image of as many parts as
/// columns: what holds for the NPY of maps holds for it.
struct NumberArray {
  std::size_t count = 1, rows = 0, columns = 0;
  /// Row by row, one matrix after the other.
  std::vector<double> numbers;
};

double number_at(const ImageChannel& channel, std::size_t i) {
  return std::visit([&](const auto& values) { return static_cast<double>(values[i]); },
                    channel.values);
}

constexpr std::string_view archive_suffix = ".npz";

/// An array in an archive.
struct ArchivedArray {
  std::string file, name;
};

/// Nothing where the text names no archive.
std::optional<ArchivedArray> archived_array(const std::string& text) {
  if (text.ends_with(archive_suffix)) return ArchivedArray{text, ""};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || !text.substr(0, colon).ends_with(archive_suffix))
    return std::nullopt;
  return ArchivedArray{text.substr(0, colon), text.substr(colon + 1)};
}

NumberArray read_array(const std::string& file) {
  const auto archived = archived_array(file);
  const DepthMap map = archived ? read_npz_array(archived->file, archived->name) : read_map(file);
  NumberArray array;
  if (map.channels.size() == 1) {
    array.rows = map.height;
    array.columns = map.width;
  } else {
    array.count = map.height;
    array.rows = map.width;
    array.columns = map.channels.size();
  }
  for (std::size_t i = 0; i < std::size_t{map.width} * map.height; ++i)
    for (const ImageChannel& channel : map.channels) array.numbers.push_back(number_at(channel, i));
  return array;
}

/// Whether a text names a file of NumPy's arrays: FILE.npy, FILE.npz or FILE.npz:ARRAY.
bool names_array(const std::string& file) {
  return std::filesystem::path(file).extension() == ".npy" || archived_array(file);
}

/// Matrices of such an array of floating point numbers: N×4×4 or N×3×4, or one of them. They are
/// called "0", "1", ….
/// Fails    InputError, naming the file.
std::vector<NamedPose> poses_of_array(const std::string& file) {
  const NumberArray array = read_array(file);
  if (array.columns != 4 || (array.rows != 3 && array.rows != 4))
    throw InputError(file + ": expected an array of the shape (N, 4, 4) or (N, 3, 4)");
  std::vector<NamedPose> poses(array.count);
  for (std::size_t n = 0; n < array.count; ++n) {
    const double* const matrix = &array.numbers[n * array.rows * 4];
    poses[n].name = std::to_string(n);
    for (std::size_t i = 0; i < 12; ++i) poses[n].pose[i / 4][i % 4] = matrix[i];
    for (std::size_t i = 12; i < array.rows * 4; ++i)
      if (matrix[i] != (i == 15 ? 1 : 0))
        throw InputError(file + ": matrix " + poses[n].name +
                         ": expected the last row to be 0 0 0 1");
  }
  return poses;
}

/// The same of N×3×3 or 3×3.
std::vector<IntrinsicMatrix> intrinsics_of_array(const std::string& file) {
  const NumberArray array = read_array(file);
  if (array.columns != 3 || array.rows != 3)
    throw InputError(file + ": expected an array of the shape (3, 3) or (N, 3, 3)");
  std::vector<IntrinsicMatrix> matrices(array.count);
  for (std::size_t i = 0; i < array.numbers.size(); ++i) matrices[i / 9][i % 9] = array.numbers[i];
  return matrices;
}

constexpr Words<PoseDirection> directions{{"world-to-camera", PoseDirection::world_to_camera},
                                          {"camera-to-world", PoseDirection::camera_to_world}};
constexpr Words<CameraAxes> axes{{"opencv", CameraAxes::opencv}, {"opengl", CameraAxes::opengl}};
constexpr Words<ScanNetStream> streams{{"depth", ScanNetStream::depth},
                                       {"colour", ScanNetStream::colour}};
constexpr Words<double> pixel_centres{{"0", 0.0}, {"0.5", 0.5}};

/// fx,fy,cx,cy; nothing where it is something else, as a file.
std::optional<IntrinsicMatrix> parse_intrinsics(const std::string& text) {
  const std::vector<std::string> parts = parse_list(text);
  if (parts.size() != 4) return std::nullopt;
  std::array<double, 4> numbers;
  for (std::size_t i = 0; i < 4; ++i) numbers[i] = parse_number(parts[i]);
  return IntrinsicMatrix{numbers[0], 0, numbers[2], 0, numbers[1], numbers[3], 0, 0, 1};
}

}  // namespace

GivenLens given_lens(const ImportArguments& a) {
  GivenLens given;
  if (a.size) {
    given.width = (*a.size)[0];
    given.height = (*a.size)[1];
  }
  if (!a.K.empty()) {
    given.K = parse_intrinsics(a.K);
    if (!given.K) throw UsageError("--K: expected fx,fy,cx,cy in pixels, found '" + a.K + "'");
  }
  given.pixel_centre = a.pixel_centre;
  return given;
}

void add_pixel_centre(Command& command, ImportArguments& a, const std::string& otherwise) {
  command.option(
      "--pixel-centre", "0|0.5",
      into(a.pixel_centre, [](const std::string& text) { return parse_word(text, pixel_centres); }),
      "Coordinate that cx and cy give the centre of the first pixel" + otherwise);
}

std::vector<NamedPose> read_poses_argument(const std::string& file) {
  return names_array(file) ? poses_of_array(file) : read_poses(file);
}

namespace {

void add_lens_options(Command& command, ImportArguments& a) {
  command.option("--K", "fx,fy,cx,cy", a.K,
                 "Use these intrinsics in pixels instead of the data set's");
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
}

void declare_matrices(Command& command, ImportArguments& a) {
  command
      .option("--K", "FILE", a.K,
              "Intrinsics: 3x3 as .txt, .npy or .npz, one for each pose or for all; or fx,fy,cx,cy")
      .required();
  command
      .option(
          "--poses", "world-to-camera|camera-to-world",
          into(a.direction, [](const std::string& text) { return parse_word(text, directions); }),
          "Direction of the matrices")
      .required();
  command
      .option("--axes", "opencv|opengl",
              into(a.axes, [](const std::string& text) { return parse_word(text, axes); }),
              "Axes of the camera: y down and z forward, or y up and z backward")
      .required();
  command
      .option("--pixel-centre", "0|0.5",
              into(a.pixel_centre,
                   [](const std::string& text) { return parse_word(text, pixel_centres); }),
              "Coordinate that cx and cy give the centre of the first pixel")
      .required();
  command
      .option("--size", "WxH", into(a.size, parse_size),
              "Size of the images in pixels, WIDTHxHEIGHT")
      .required();
}

Cameras read_matrices(const ImportArguments& a, Warnings&) {
  std::vector<IntrinsicMatrix> K;
  if (const auto numbers = parse_intrinsics(a.K))
    K = {*numbers};
  else
    K = names_array(a.K) ? intrinsics_of_array(a.K) : read_intrinsic_matrices(a.K);
  const auto [width, height] = *a.size;
  return import_matrices(read_poses_argument(a.input), K, {*a.direction, *a.axes, *a.pixel_centre},
                         width, height, a.input);
}

void declare_tum(Command& command, ImportArguments& a) {
  command
      .option("--K", "LENS", a.K,
              "Intrinsics: fx,fy,cx,cy in pixels, or ros (for depth), freiburg1, freiburg2 or "
              "freiburg3 (for colour)")
      .required();
  command.option("--images", "FILE", a.images,
                 "List of images, rgb.txt or depth.txt; each image gets the pose nearest in time");
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
}

std::optional<std::filesystem::path> path_if(const std::string& file) {
  return file.empty() ? std::nullopt : std::optional<std::filesystem::path>(file);
}

Cameras read_tum(const ImportArguments& a, Warnings&) {
  std::optional<ImportedCamera> lens = tum_lens(a.K);
  if (!lens) return import_tum(a.input, path_if(a.images), tum_lens(given_lens(a)));
  if (a.size)
    std::tie(lens->camera.width, lens->camera.height) = std::pair((*a.size)[0], (*a.size)[1]);
  if (a.pixel_centre) lens->camera.projection.pixel_centre = *a.pixel_centre;
  return import_tum(a.input, path_if(a.images), *lens);
}

Cameras read_7scenes(const ImportArguments& a, Warnings&) {
  return import_7scenes(a.input, given_lens(a));
}

void declare_scannet(Command& command, ImportArguments& a) {
  command.option("--stream", "depth|colour",
                 into(a.stream, [](const std::string& text) { return parse_word(text, streams); }),
                 "Images to import (default depth)");
  add_lens_options(command, a);
}

Cameras read_scannet(const ImportArguments& a, Warnings&) {
  return import_scannet(a.input, a.stream, given_lens(a));
}

Cameras read_scannetpp(const ImportArguments& a, Warnings&) {
  return import_scannetpp(a.input, given_lens(a));
}

Cameras read_replica(const ImportArguments& a, Warnings&) {
  return import_replica(a.input, given_lens(a));
}

void declare_kitti(Command& command, ImportArguments& a) {
  command.option("--poses", "FILE", a.poses,
                 "Poses from camera 0 to world, one line per frame: poses/NN.txt");
  command.option("--camera", "N", into(a.number, parse_count),
                 "Camera to import with poses: 0 or 1 (grey), 2 or 3 (colour)");
  add_size_option(command, a);
  add_pixel_centre(command, a, " (default 0)");
}

Cameras read_kitti(const ImportArguments& a, Warnings&) {
  return import_kitti(a.input, path_if(a.poses), a.number, given_lens(a));
}

}  // namespace

std::vector<ImportSource> data_set_sources() {
  return {
      {"matrices", "Import intrinsics and poses from text, .npy or .npz",
       "A file or folder of matrices: .txt, .npy, .npz or .npz:ARRAY",
       "  fathom camera import matrices poses.npy --K K.txt --size 640x480 \\\n"
       "    --poses camera-to-world --axes opencv --pixel-centre 0 -o cameras.json\n"
       "\nA text file contains one 3x4 or 4x4 matrix, or one matrix per line. A folder contains "
       "one text file per image.",
       declare_matrices, read_matrices},
      {"tum", "Import cameras of TUM RGB-D: groundtruth.txt",
       "groundtruth.txt, or the folder with it",
       "  fathom camera import tum groundtruth.txt --images depth.txt --K ros \\\n"
       "    -o cameras.json",
       declare_tum, read_tum},
      {"7scenes", "Import cameras of 7-Scenes: frame-XXXXXX.pose.txt", "The folder of a sequence",
       "  fathom camera import 7scenes chess/seq-01 -o cameras.json", add_lens_options,
       read_7scenes},
      {"scannet", "Import cameras of ScanNet: pose/N.txt and intrinsic/", "The folder of a scene",
       "  fathom camera import scannet scene0000_00 --stream colour -o cameras.json",
       declare_scannet, read_scannet},
      {"scannetpp", "Import cameras of ScanNet++: iphone/pose_intrinsic_imu.json",
       "pose_intrinsic_imu.json",
       "  fathom camera import scannetpp iphone/pose_intrinsic_imu.json -o cameras.json\n"
       "\nIts DSLR images have cameras for `import colmap` and `import nerf`.",
       add_lens_options, read_scannetpp},
      {"replica", "Import cameras of Replica (iMAP, NICE-SLAM): traj.txt", "The folder of a scene",
       "  fathom camera import replica Replica/room0 -o cameras.json", add_lens_options,
       read_replica},
      {"kitti", "Import cameras of KITTI: calib.txt or calib_cam_to_cam.txt", "The calibration",
       "  fathom camera import kitti calib.txt --poses poses/00.txt --camera 2 \\\n"
       "    --size 1241x376 -o cameras.json\n"
       "  fathom camera import kitti calib_cam_to_cam.txt --image image_02 -o cam.json",
       declare_kitti, read_kitti}};
}

}  // namespace fathom::app
