#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kinect_width = 640, kinect_height = 480;

/// In seconds: the greatest difference that the benchmark's own associate.py accepts.
constexpr double largest_difference = 0.02;

/// A lens that the benchmark publishes for colour images. Those with distortion are not the lenses
/// of its depth images, which the driver has registered to a pinhole camera.
struct PublishedLens {
  const char* name;
  double fx, fy, cx, cy;
  bool distorted;
};

constexpr std::array<PublishedLens, 4> published{
    {{"ros", 525, 525, 319.5, 239.5, false},
     {"freiburg1", 517.3, 516.5, 318.6, 255.3, true},
     {"freiburg2", 520.9, 521, 325.1, 249.7, true},
     {"freiburg3", 535.4, 539.2, 320.1, 247.6, false}}};

struct TimedPose {
  double time = 0;
  std::string name;
  Pose world_to_camera{};
  /// "FILE: line N".
  std::string where;
  /// Why the line is not a pose.
  std::string fault;
};

TimedPose read_timed_pose(Line& line) {
  const TumPose given = read_tum_pose(line);
  TimedPose result{given.time, given.time_text, {}, line.where, given.fault};
  if (result.fault.empty())
    result.world_to_camera =
        view_from({given.position[0], given.position[1], given.position[2]}, given.quaternion);
  return result;
}

ImportedCamera camera_at(const TimedPose& timed, const ImportedCamera& lens) {
  ImportedCamera result = lens;
  result.camera.name = timed.name;
  if (result.fault.empty()) result.fault = timed.fault;
  if (!result.fault.empty()) return result;
  result.camera.world_to_camera = timed.world_to_camera;
  if (const auto fault = find_fault(result.camera)) result.fault = timed.where + ": " + *fault;
  return result;
}

/// The nearest in time; `poses` are in its order and not empty.
const TimedPose& nearest(const std::vector<TimedPose>& poses, double time) {
  const auto after = std::ranges::lower_bound(poses, time, {}, &TimedPose::time);
  if (after == poses.begin()) return *after;
  const auto before = std::prev(after);
  if (after == poses.end()) return *before;
  return time - before->time <= after->time - time ? *before : *after;
}

std::vector<ImportedCamera> of_images(std::vector<TimedPose> poses, const NamedText& images,
                                      const ImportedCamera& lens) {
  std::ranges::stable_sort(poses, {}, &TimedPose::time);
  std::vector<ImportedCamera> cameras;
  for (Line& line : lines_of(images.text, images.name)) {
    std::string time_text, file;
    const double time = read_time(line, time_text);
    std::getline(line.words >> std::ws, file);
    if (file.empty()) throw InputError(line.where + ": the image's file is missing");
    TimedPose own = nearest(poses, time);
    own.name = file;
    ImportedCamera camera = camera_at(own, lens);
    if (std::abs(own.time - time) > largest_difference)
      camera.absence = line.where + ": the trajectory has no pose within 0.02 s of " + time_text;
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty()) throw InputError(images.name + ": holds no image");
  return cameras;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_tum(const NamedText& trajectory,
                                              const std::optional<NamedText>& images,
                                              const ImportedCamera& lens) {
  std::vector<TimedPose> poses;
  for (Line& line : lines_of(trajectory.text, trajectory.name))
    poses.push_back(read_timed_pose(line));
  if (poses.empty()) throw InputError(trajectory.name + ": holds no pose");
  std::vector<ImportedCamera> cameras;
  if (images) {
    cameras = of_images(std::move(poses), *images, lens);
  } else {
    for (const TimedPose& each : poses) cameras.push_back(camera_at(each, lens));
  }
  require_different_names(cameras, images ? images->name : trajectory.name);
  return cameras;
}

std::optional<ImportedCamera> tum_lens(const std::string& name) {
  const StandardArithmetic standard;
  const auto* found = std::find_if(published.begin(), published.end(),
                                   [&](const PublishedLens& lens) { return name == lens.name; });
  if (found == published.end()) return std::nullopt;
  ImportedCamera lens =
      tum_lens(GivenLens{.K = intrinsic_matrix(found->fx, found->fy, found->cx, found->cy)});
  if (found->distorted)
    lens.distortion = name + ": its colour images have lens distortion (ros is for depth images)";
  return lens;
}

ImportedCamera tum_lens(const GivenLens& given) {
  const StandardArithmetic standard;
  if (!given.K)
    throw UsageError(
        "a trajectory has no intrinsics: give K, or one of ros, freiburg1, freiburg2 "
        "and freiburg3");
  ImportedCamera lens;
  const GivenLens usual{.width = kinect_width, .height = kinect_height};
  lens.camera = lens_of(given, usual, "K");
  if (const auto fault = find_fault(lens.camera)) lens.fault = "K: " + *fault;
  return lens;
}

std::vector<ImportedCamera> import_tum(const fs::path& trajectory,
                                       const std::optional<fs::path>& images,
                                       const ImportedCamera& lens) {
  const StandardArithmetic standard;
  std::error_code ignored;
  const fs::path file =
      fs::is_directory(trajectory, ignored) ? trajectory / "groundtruth.txt" : trajectory;
  const files::InputFile poses(file);
  const NamedText named{poses.text(), file.string()};
  if (!images) return parse_tum(named, std::nullopt, lens);
  const files::InputFile list(*images);
  return parse_tum(named, NamedText{list.text(), images->string()}, lens);
}

namespace {

GivenLens read_parameters(const NamedText& file) {
  const text::JsonDocument document(file.text, file.name);
  const text::JsonValue camera = document.root().at("camera");
  const auto size = [&](const char* key) {
    return static_cast<std::uint32_t>(
        camera.at(key).integer(1, std::numeric_limits<std::uint32_t>::max()));
  };
  const auto number = [&](const char* key) { return camera.at(key).number(); };
  return {.width = size("w"),
          .height = size("h"),
          .K = intrinsic_matrix(number("fx"), number("fy"), number("cx"), number("cy"))};
}

}  // namespace

std::vector<ImportedCamera> camera::parse_replica(const NamedText& trajectory,
                                                  const std::optional<NamedText>& parameters,
                                                  const GivenLens& given) {
  const GivenLens rendered = parameters ? read_parameters(*parameters) : GivenLens{};
  ImportedCamera lens;
  lens.camera = lens_of(given, rendered, parameters ? parameters->name : "K");
  std::vector<ImportedCamera> cameras;
  for (Line& line : lines_of(trajectory.text, trajectory.name)) {
    const std::string frame = fmt::format("frame{:06}", cameras.size());
    cameras.push_back(imported_camera(frame, line.where, [&](ImportedCamera& one) {
      one = placed(lens, {frame, pose_of_numbers(rest_of(line), line.where)},
                   PoseDirection::camera_to_world, CameraAxes::opencv, line.where);
    }));
  }
  if (cameras.empty()) throw InputError(trajectory.name + ": holds no pose");
  return cameras;
}

std::vector<ImportedCamera> import_replica(const fs::path& folder, const GivenLens& given) {
  const StandardArithmetic standard;
  const fs::path trajectory = folder / "traj.txt";
  const files::InputFile poses(trajectory);
  const NamedText named{poses.text(), trajectory.string()};
  if (given.K && given.width != 0) return parse_replica(named, std::nullopt, given);
  std::error_code ignored;
  const fs::path beside = folder / "cam_params.json", above = folder / ".." / "cam_params.json";
  if (!fs::exists(beside, ignored) && !fs::exists(above, ignored))
    throw InputError(folder.string() +
                     ": cam_params.json is neither here nor in the folder above; give K and the "
                     "image size instead");
  const fs::path file = fs::exists(beside, ignored) ? beside : above;
  const files::InputFile parameters(file);
  return parse_replica(named, NamedText{parameters.text(), file.string()}, given);
}

}  // namespace fathom
