#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
using namespace camera;

namespace fs = std::filesystem;

namespace {

using ProjectionMatrix = std::array<std::array<double, 4>, 3>;

/// P = K·[I | t] of a rectified camera, from rectified camera 0.
struct RectifiedCamera {
  /// The name of the folder with its images.
  std::string name;
  std::string where;
  ProjectionMatrix P{};
  std::uint32_t width = 0, height = 0;
};

/// A line "KEY: numbers".
struct Entry {
  std::string where;
  std::vector<double> numbers;
};

std::map<std::string, Entry> read_entries(const NamedText& file) {
  std::map<std::string, Entry> entries;
  for (Line& line : lines_of(file.text, file.name)) {
    std::string key = read_word(line, "a key");
    if (!key.ends_with(':')) continue;
    key.pop_back();
    // Dates, and what other programs add, are of no concern.
    if (!key.starts_with("P") && !key.starts_with("S_rect_")) continue;
    if (!entries.emplace(key, Entry{line.where, rest_of(line)}).second)
      throw InputError(line.where + ": " + key + " stands twice");
  }
  return entries;
}

std::uint32_t size_of(const Entry& entry, std::size_t i) {
  const double size = i < entry.numbers.size() ? entry.numbers[i] : 0;
  if (!(size >= 1 && size <= std::numeric_limits<std::uint32_t>::max()) || size != std::floor(size))
    throw InputError(entry.where + ": expected the image's width and height");
  return static_cast<std::uint32_t>(size);
}

ProjectionMatrix projection_of(const Entry& entry) {
  if (entry.numbers.size() != 12)
    throw InputError(entry.where + ": expected 3 rows of 4 numbers, found " +
                     std::to_string(entry.numbers.size()));
  return pose_of_numbers(entry.numbers, entry.where);
}

/// Cameras 0 to 3 of either file, as many as it has.
std::vector<RectifiedCamera> read_rectified(const NamedText& file) {
  const std::map<std::string, Entry> entries = read_entries(file);
  std::vector<RectifiedCamera> cameras;
  for (int i = 0; i < 4; ++i) {
    const auto odometry = entries.find(fmt::format("P{}", i)),
               raw = entries.find(fmt::format("P_rect_{:02}", i)),
               size = entries.find(fmt::format("S_rect_{:02}", i));
    if (odometry != entries.end()) {
      cameras.push_back(
          {fmt::format("image_{}", i), odometry->second.where, projection_of(odometry->second)});
    } else if (raw != entries.end()) {
      cameras.push_back(
          {fmt::format("image_{:02}", i), raw->second.where, projection_of(raw->second)});
      if (size != entries.end()) {
        cameras.back().width = size_of(size->second, 0);
        cameras.back().height = size_of(size->second, 1);
      }
    }
  }
  if (cameras.empty())
    throw InputError(file.name + ": expected P0 to P3 (odometry) or P_rect_00 to P_rect_03 (raw)");
  return cameras;
}

ImportedCamera lens_of(const RectifiedCamera& camera, const GivenLens& given) {
  const ProjectionMatrix& P = camera.P;
  if (given.K) throw UsageError("the calibration has K: another one cannot be given");
  if (given.width == 0 && camera.width == 0)
    throw UsageError("the calibration has no image size: give one, as 1241x376");
  return imported_camera(camera.name, camera.where, [&](ImportedCamera& one) {
    const IntrinsicMatrix K{P[0][0], P[0][1], P[0][2], P[1][0], P[1][1],
                            P[1][2], P[2][0], P[2][1], P[2][2]};
    one.camera = camera::lens_of(given, {.width = camera.width, .height = camera.height, .K = K},
                                 camera.where);
    for (const auto& row : P)
      for (const double entry : row)
        if (!std::isfinite(entry)) throw InputError(camera.where + ": a number is not finite");
  });
}

/// t = K⁻¹·p of the last column p of P, exactly; K is upper triangular with 1 in its corner.
std::array<Ratio, 3> offset_of(const ProjectionMatrix& P) {
  const Dyadic fx = P[0][0], s = P[0][1], cx = P[0][2], fy = P[1][1], cy = P[1][2];
  const Dyadic z = P[2][3];
  const Dyadic fy_y = Dyadic(P[1][3]) - cy * z;
  const Dyadic fx_fy_x = (Dyadic(P[0][3]) - cx * z) * fy - s * fy_y;
  return {Ratio(fx_fy_x, fx * fy), Ratio(fy_y, fy), Ratio(z)};
}

/// [A⁻¹ | t − A⁻¹·b] of camera 0's pose [A | b] in the world, each entry rounded once.
Pose beside(const Pose& world_from_camera0, const std::array<Ratio, 3>& t,
            const std::string& where) {
  // The rotation of the inverse; its exact translation, plus t.
  Pose pose = camera_from_world(world_from_camera0, PoseDirection::camera_to_world,
                                CameraAxes::opencv, where);
  const auto exact = exact_inverse(world_from_camera0);
  for (std::size_t i = 0; i < 3; ++i) pose[i][3] = round_to_binary64(t[i] + exact->at(i)[3]);
  return pose;
}

std::vector<ImportedCamera> of_frames(const RectifiedCamera& camera, const NamedText& poses,
                                      const GivenLens& given) {
  const ImportedCamera lens = lens_of(camera, given);
  std::vector<ImportedCamera> cameras;
  for (Line& line : lines_of(poses.text, poses.name)) {
    const std::string frame = fmt::format("{:06}", cameras.size());
    cameras.push_back(imported_camera(frame, line.where, [&](ImportedCamera& one) {
      one = lens;
      if (!one.fault.empty()) return;
      const std::vector<double> numbers = rest_of(line);
      one.camera.world_to_camera =
          beside(pose_of_numbers(numbers, line.where), offset_of(camera.P), line.where);
    }));
  }
  if (cameras.empty()) throw InputError(poses.name + ": holds no pose");
  return cameras;
}

const RectifiedCamera& the_camera(const std::vector<RectifiedCamera>& cameras, std::uint32_t number,
                                  const std::string& file) {
  for (const RectifiedCamera& camera : cameras)
    if (camera.name.back() == static_cast<char>('0' + number % 10) && number < 10) return camera;
  throw InputError(fmt::format("{}: has no camera {}", file, number));
}

}  // namespace

std::vector<ImportedCamera> camera::parse_kitti(const NamedText& calibration,
                                                const std::optional<NamedText>& poses,
                                                std::optional<std::uint32_t> number,
                                                const GivenLens& given) {
  const std::vector<RectifiedCamera> cameras = read_rectified(calibration);
  if (poses) {
    if (!number)
      throw UsageError("poses need the number of a camera: 0, 1 (grey), 2 or 3 (colour)");
    return of_frames(the_camera(cameras, *number, calibration.name), *poses, given);
  }
  std::vector<ImportedCamera> result;
  for (const RectifiedCamera& camera : cameras) {
    ImportedCamera one = lens_of(camera, given);
    if (one.fault.empty()) {
      const std::array<Ratio, 3> t = offset_of(camera.P);
      for (std::size_t i = 0; i < 3; ++i)
        one.camera.world_to_camera[i][3] = round_to_binary64(t[i]);
      if (const auto fault = find_fault(one.camera)) one.fault = camera.where + ": " + *fault;
    }
    result.push_back(std::move(one));
  }
  return result;
}

std::vector<ImportedCamera> import_kitti(const fs::path& calibration,
                                         const std::optional<fs::path>& poses,
                                         std::optional<std::uint32_t> number,
                                         const GivenLens& given) {
  const StandardArithmetic standard;
  const files::InputFile file(calibration);
  const NamedText named{file.text(), calibration.string()};
  if (!poses) return parse_kitti(named, std::nullopt, number, given);
  const files::InputFile trajectory(*poses);
  return parse_kitti(named, NamedText{trajectory.text(), poses->string()}, number, given);
}

}  // namespace fathom
