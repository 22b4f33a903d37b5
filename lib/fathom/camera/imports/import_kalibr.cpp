#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 1> of_omni{"xi"}, of_fov{"omega"};
constexpr std::array<std::string_view, 2> of_eucm{"alpha", "beta"}, of_ds{"xi", "alpha"};
constexpr std::array<std::string_view, 4> of_radtan{"k1", "k2", "p1", "p2"},
    of_equidistant{"k1", "k2", "k3", "k4"};

/// A camera_model of Kalibr.
struct ProjectionOfKalibr {
  std::string_view name;
  /// Its lens model; a pinhole has the model of its distortion.
  std::string_view lens;
  /// The parameters before fu fv pu pv, by their names in the lens model.
  Names parameters;
  /// The distortion_models that Kalibr combines with it.
  Names distortions;
};

/// A distortion_model of Kalibr.
struct DistortionOfKalibr {
  std::string_view name;
  /// The lens model that it makes of a pinhole.
  std::string_view lens;
  Names parameters;
};

constexpr std::array<std::string_view, 4> every_distortion{"none", "radtan", "equidistant", "fov"};

constexpr std::array<ProjectionOfKalibr, 4> projections{
    {{"pinhole", {}, {}, every_distortion},
     {"omni", "OMNI", of_omni, Names(every_distortion).first(2)},
     {"eucm", "EUCM", of_eucm, Names(every_distortion).first(1)},
     {"ds", "DOUBLE_SPHERE", of_ds, Names(every_distortion).first(1)}}};

constexpr std::array<DistortionOfKalibr, 4> distortions{
    {{"none", "PINHOLE", {}},
     {"radtan", "OPENCV", of_radtan},
     {"equidistant", "OPENCV_FISHEYE", of_equidistant},
     {"fov", "FOV", of_fov}}};

template <class Model>
std::string names_of_models(std::span<const Model> models) {
  std::vector<std::string> names;
  for (const Model& model : models) names.emplace_back(model.name);
  return joined(names, " or ");
}

template <class Model>
const Model& model_of(const JsonValue& name, std::span<const Model> models) {
  for (const Model& model : models)
    if (model.name == name.string()) return model;
  name.fail("found " + text::printable(name.string()) + ", expected " + names_of_models(models));
}

void add_numbers(const std::vector<double>& values, Names parameters,
                 std::vector<LensNumber>& numbers) {
  for (std::size_t i = 0; i < parameters.size(); ++i) numbers.push_back({parameters[i], values[i]});
}

void read_lens(const JsonValue& cam, ImportedCamera& one) {
  const JsonValue model = cam.at("distortion_model");
  const ProjectionOfKalibr& projection =
      model_of(cam.at("camera_model"), std::span<const ProjectionOfKalibr>(projections));
  const DistortionOfKalibr& distortion =
      model_of(model, std::span<const DistortionOfKalibr>(distortions));
  if (std::ranges::find(projection.distortions, distortion.name) == projection.distortions.end())
    model.fail("Kalibr has no " + std::string(projection.name) + " with " +
               std::string(distortion.name));

  const std::size_t before = projection.parameters.size();
  const std::vector<double> intrinsics = cam.at("intrinsics").numbers(before + 4);
  one.camera.projection.fx = intrinsics[before];
  one.camera.projection.fy = intrinsics[before + 1];
  one.camera.projection.cx = intrinsics[before + 2];
  one.camera.projection.cy = intrinsics[before + 3];

  std::vector<LensNumber> numbers;
  add_numbers(intrinsics, projection.parameters, numbers);
  add_numbers(cam.at("distortion_coeffs").numbers(distortion.parameters.size()),
              distortion.parameters, numbers);
  set_lens(one, projection.lens.empty() ? distortion.lens : projection.lens, numbers, cam.where());
}

void read_size(const JsonValue& cam, const GivenLens& given, Camera& camera) {
  const auto size = cam.at("resolution").elements(2);
  const auto pixels = [](const JsonValue& value) {
    return static_cast<std::uint32_t>(value.integer(1, std::numeric_limits<std::uint32_t>::max()));
  };
  camera.width = given.width != 0 ? given.width : pixels(size[0]);
  camera.height = given.height != 0 ? given.height : pixels(size[1]);
}

/// A map of points, [A | b], exactly.
using ExactPose = std::array<std::array<Ratio, 4>, 3>;

ExactPose exact(const Pose& pose) {
  ExactPose result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) result[i][k] = Ratio(Dyadic(pose[i][k]));
  return result;
}

/// `second` after `first`.
ExactPose composed(const ExactPose& second, const ExactPose& first) {
  ExactPose result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      Ratio sum = k == 3 ? second[i][3] : Ratio();
      for (std::size_t j = 0; j < 3; ++j) sum = sum + second[i][j] * first[j][k];
      result[i][k] = sum;
    }
  return result;
}

Pose rounded(const ExactPose& pose) {
  Pose result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) result[i][k] = round_to_binary64(pose[i][k]);
  return result;
}

Pose read_pose(const JsonValue& matrix) {
  std::vector<double> numbers;
  for (const JsonValue& row : matrix.elements(4)) {
    const auto four = row.numbers(4);
    numbers.insert(numbers.end(), four.begin(), four.end());
  }
  return pose_of_numbers(numbers, matrix.where());
}

/// A camera of the chain without its pose, and its pose from the first camera's frame; none if it
/// has a fault.
struct Link {
  ImportedCamera camera;
  std::optional<ExactPose> from_first;
};

ExactPose from_first(const JsonValue& cam, const std::optional<ExactPose>& previous) {
  if (!previous) cam.fail("stands on the previous camera, whose pose has a fault");
  return composed(exact(read_pose(cam.at("T_cn_cnm1"))), *previous);
}

Link read_link(const JsonValue& cam, const std::string& name, const GivenLens& given,
               const Link* previous) {
  Link link;
  link.camera = imported_camera(name, cam.where(), [&](ImportedCamera& one) {
    link.from_first =
        previous ? from_first(cam, previous->from_first) : exact(one.camera.world_to_camera);
    read_size(cam, given, one.camera);
    one.camera.projection.pixel_centre = given.pixel_centre.value_or(0);
    read_lens(cam, one);
  });
  return link;
}

/// The cameras cam0, cam1, … of the file; other keys are of no concern.
std::vector<Link> read_chain(const JsonValue& root, const GivenLens& given) {
  std::vector<Link> chain;
  for (;;) {
    const std::string name = "cam" + std::to_string(chain.size());
    const auto cam = root.find(name);
    if (!cam) break;
    chain.push_back(read_link(*cam, name, given, chain.empty() ? nullptr : &chain.back()));
  }
  if (chain.empty()) root.fail("has no camera: expected cam0, cam1, …");
  return chain;
}

/// World to the first camera.
ExactPose first_from_world(const Pose& pose, PoseDirection direction, const std::string& where) {
  require_finite(pose, where);
  if (direction == PoseDirection::world_to_camera) return exact(pose);
  const auto inverted = exact_inverse(pose);
  if (!inverted) throw InputError(where + ": the matrix is singular");
  return *inverted;
}

/// The camera at a pose of the first one.
ImportedCamera placed_link(const Link& link, const NamedPose& pose, PoseDirection direction,
                           const std::string& where) {
  const std::string& own = link.camera.camera.name;
  const std::string name = pose.name.empty() ? own : own + "/" + pose.name;
  return imported_camera(name, where, [&](ImportedCamera& one) {
    one = link.camera;
    if (!one.fault.empty()) return;
    one.camera.world_to_camera =
        rounded(composed(*link.from_first, first_from_world(pose.pose, direction, where)));
  });
}

}  // namespace

std::vector<ImportedCamera> cameras_of_kalibr(std::string_view json, const std::string& file,
                                              const GivenLens& given,
                                              const CalibrationPoses& poses) {
  const StandardArithmetic standard;
  const text::JsonDocument document(json, file);
  const std::vector<Link> chain = read_chain(document.root(), given);
  const std::vector<NamedPose> at_origin{{"", Camera().world_to_camera}};
  std::vector<ImportedCamera> cameras;
  for (const NamedPose& pose : poses.poses.empty() ? at_origin : poses.poses)
    for (const Link& link : chain)
      cameras.push_back(placed_link(link, pose, poses.direction, file));
  require_different_names(cameras, file);
  return cameras;
}

}  // namespace fathom
