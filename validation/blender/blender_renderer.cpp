#include "validation/blender/blender_renderer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/named_models.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/image/map_files.h"
#include "validation/blender/blender_panorama.h"
#include "validation/blender/blender_script.h"
#include "validation/child/child_process.h"

namespace fathom::validation {
namespace {

/// A folder for the files of another program. It is removed at the end, even if this process is
/// killed: a second process waits for that.
class Workplace {
 public:
  /// Fails    InputError if no folder can be made.
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  /// Fails    InputError if the file cannot be written.
  void write(const std::string& name, const std::string& bytes) const;
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) const {
    write(name,
          std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }

 private:
  std::filesystem::path path_;
  int alive_ = -1;  ///< open as long as this process lives
  pid_t remover_ = -1;
};

/// Waits until nobody has the other end of `pipe` any more, then removes the folder.
[[noreturn]] void wait_and_remove(int pipe, const std::filesystem::path& folder) {
  ::setpgid(0, 0);  // is not ended with the others
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  char byte = 0;
  while (::read(pipe, &byte, 1) < 0 && errno == EINTR) {
  }
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  ::_exit(0);
}

Workplace::Workplace() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) throw InputError("the folder for temporary files, TMPDIR: " + error.message());
  std::string name = (folder / "fathom-validate-XXXXXX").string();
  std::array<int, 2> ends{};
  if (::mkdtemp(name.data()) == nullptr || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw InputError("cannot make a folder for a renderer's files in " + folder.string());
  }
  path_ = name;
  remover_ = ::fork();
  if (remover_ == 0) {
    ::close(ends[1]);
    wait_and_remove(ends[0], path_);
  }
  ::close(ends[0]);
  alive_ = ends[1];
}

Workplace::~Workplace() {
  ::close(alive_);
  if (remover_ > 0) ::waitpid(remover_, nullptr, 0);
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

void Workplace::write(const std::string& name, const std::string& bytes) const {
  std::ofstream file(path_ / name, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw InputError("cannot write a renderer's files in " + path_.string());
}

using attribution::model_named;
using attribution::other_map;
using attribution::RayModel;
using attribution::WorldMesh;

/// A camera in Blender's terms (docs/conventions.md). Blender keeps all of it in binary32.
struct BlenderCamera {
  bool perspective = true;
  /// Perspective: the focal length in millimetres, for a sensor 36 mm wide, fitted to the image's
  /// width. Orthographic: the width of the image in scene units.
  double lens = 0, ortho_scale = 0;
  /// In widths of the image.
  double shift_x = 0, shift_y = 0;
  double aspect_x = 1, aspect_y = 1;
  /// Instead of the above.
  std::optional<BlenderPanorama> panorama;
  /// Camera to world, row by row; the camera's axes are Blender's: x right, y up, −z forward.
  std::array<double, 16> world_from_camera{};
};

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("blender: cannot express " + what);
}

void require_rotation(const Eigen::Matrix3d& R) {
  const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
  if (off.cwiseAbs().maxCoeff() > 1e-6) refuse("a camera whose R is no rotation");
}

/// Camera to world; Blender's camera has y up and z backward.
std::array<double, 16> world_from_blender(const Camera& camera) {
  std::array<double, 16> rows{};
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> world_from_camera(rows.data());
  const auto camera_from_world = geometry::as_matrix(camera.world_to_camera);
  const Eigen::Matrix3d R = camera_from_world.leftCols<3>();
  world_from_camera.setIdentity();
  world_from_camera.topLeftCorner<3, 3>() = R.transpose() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  world_from_camera.col(3).head<3>() = -R.transpose() * camera_from_world.col(3);
  return rows;
}

/// Fails    InputError if Blender cannot express the camera: skew, an R that is not a rotation (up
///          to 10⁻⁶), mirrored axes, pixels more than twice as wide as high or the reverse.
BlenderCamera blender_camera(const Camera& camera) {
  if (bends_rays(camera.projection)) {
    BlenderCamera made{.panorama = panorama_of(camera)};
    if (!made.panorama) refuse("this camera with a lens");
    made.world_from_camera = world_from_blender(camera);
    return made;
  }
  if (camera.projection.skew != 0) refuse("a camera with skew");
  if (camera.projection.fx <= 0 || camera.projection.fy <= 0) refuse("a mirrored camera");
  const auto camera_from_world = geometry::as_matrix(camera.world_to_camera);
  require_rotation(camera_from_world.leftCols<3>());
  const double pixel = camera.projection.fx / camera.projection.fy;  // aspect_y / aspect_x
  if (pixel > 2 || pixel < 0.5) refuse("pixels more than twice as wide as high, or the reverse");
  const double width = camera.width, height = camera.height;
  const auto [cx, cy] = principal_point(camera.projection);

  BlenderCamera made;
  made.perspective = is_perspective(camera.projection);
  made.aspect_x = std::max(1.0, 1 / pixel);
  made.aspect_y = std::max(1.0, pixel);
  made.lens = camera.projection.fx * blender_sensor_width / width;
  made.ortho_scale = width / camera.projection.fx;
  made.shift_x = (width / 2 - cx) / width;
  made.shift_y = (cy - height / 2) * pixel / width;
  made.world_from_camera = world_from_blender(camera);
  return made;
}

std::string version() {
  const Said answer = run_command({"blender", "--version"});
  if (answer.status == 127) {
    throw InputError("blender is not installed: the package blender provides it");
  }
  return answer.text.substr(0, answer.text.find('\n'));
}

/// The translation that makes `shift` the origin of the world.
Camera moved(Camera camera, const std::array<double, 3>& shift) {
  for (auto& row : camera.world_to_camera) {
    for (std::size_t k = 0; k < 3; ++k) row[3] += row[k] * shift[k];
  }
  return camera;
}

/// Blender draws panoramas at the origin.
std::array<double, 3> middle_of(const WorldMesh& mesh, const Camera& camera) {
  std::array<double, 3> middle{};
  if (bends_rays(camera.projection)) return middle;
  const auto box = box_of(mesh);
  if (!box) return middle;
  for (std::size_t k = 0; k < 3; ++k) {
    const double least = box->lower[k], greatest = box->upper[k];
    // Only what binary32 would hurt is moved.
    const double size = greatest - least, away = std::max(std::abs(least), std::abs(greatest));
    if (away > 16 * size) middle[k] = static_cast<float>(least / 2 + greatest / 2);
  }
  return middle;
}

std::string scene_json(const Camera& camera, const BlenderCamera& b) {
  std::string rows;
  for (std::size_t r = 0; r < 4; ++r) {
    const auto& m = b.world_from_camera;
    rows += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}, {:.17g}]", r == 0 ? "" : ", ", m[4 * r],
                        m[4 * r + 1], m[4 * r + 2], m[4 * r + 3]);
  }
  const BlenderPanorama panorama = b.panorama.value_or(BlenderPanorama());
  const std::string type = b.panorama ? name_of(panorama.type) : "";
  return fmt::format(
      R"({{"camera": {{"panorama": "{}", "fisheye_fov": {:.17g}, "fisheye_lens": {:.17g},
 "perspective": {}, "lens": {:.17g}, "ortho_scale": {:.17g},
 "shift_x": {:.17g}, "shift_y": {:.17g}, "aspect_x": {:.17g}, "aspect_y": {:.17g},
 "near": {:.17g}, "far": {:.17g}, "width": {}, "height": {},
 "world_from_camera": [{}]}}}})",
      type, panorama.fov, panorama.lens, b.perspective ? "true" : "false", b.lens, b.ortho_scale,
      b.shift_x, b.shift_y, b.aspect_x, b.aspect_y, camera.near, camera.far, camera.width,
      camera.height, rows);
}

void hand_over(const Workplace& place, const WorldMesh& mesh, const std::array<double, 3>& shift,
               const Camera& camera) {
  std::vector<float> points;
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k] - shift[k]));
  }
  place.write("points.bin", points);
  std::vector<std::int32_t> corners;
  for (const CornerIndices& t : mesh.triangles) {
    for (const std::uint32_t corner : t) corners.push_back(static_cast<std::int32_t>(corner));
  }
  place.write("triangles.bin", corners);
  const Camera here = moved(camera, shift);
  place.write("scene.json", scene_json(here, blender_camera(here)));
  place.write("render.py", std::string(blender_script));
}

/// The last line that Blender wrote about an error.
std::string complaint(const std::string& text) {
  std::string found = "it wrote no map";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find("Error") != std::string::npos) found = line;
    begin = end + 1;
  }
  return found;
}

}  // namespace

DrawnMap draw_blender(const WorldMesh& mesh, const Camera& camera) {
  DrawnMap drawn{.version = version()};
  const Workplace place;
  drawn.model = model_named("cycles");
  drawn.model.name = "Cycles";
  drawn.model.sample.error = blender_sample_error;
  auto& model = std::get<RayModel>(drawn.model.kind);
  model.shift = middle_of(mesh, camera);
  hand_over(place, mesh, model.shift, camera);
  // Whoever ends this process ends Blender with it.
  const Said answer = run_command({"setpriv", "--pdeathsig", "KILL", "blender", "-b",
                                   "--factory-startup", "-noaudio", "--python-exit-code", "1",
                                   "--python", (place / "render.py").string()});
  if (answer.status > 128) {
    throw InputError(fmt::format("blender: ended by signal {}", answer.status - 128));
  }
  std::error_code error;
  if (answer.status != 0 || !std::filesystem::exists(place / "depth.exr", error)) {
    throw InputError("blender: failed: " + complaint(answer.text));
  }
  drawn.map = other_map(read_map(place / "depth.exr"), "ViewLayer.Depth.Z");
  return drawn;
}

}  // namespace fathom::validation
