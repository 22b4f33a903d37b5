#include <fmt/core.h>

#include <limits>

#include "fathom/camera/import_lines.h"
#include "fathom/camera/posed_cameras.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;

namespace fs = std::filesystem;

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
