#include <algorithm>
#include <array>
#include <span>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 1> kalibr_omni{"xi"}, kalibr_fov{"omega"};
constexpr std::array<std::string_view, 2> kalibr_eucm{"alpha", "beta"}, kalibr_ds{"xi", "alpha"};
constexpr std::array<std::string_view, 4> kalibr_radtan{"k1", "k2", "p1", "p2"},
    kalibr_equidistant{"k1", "k2", "k3", "k4"};

/// A camera_model of Kalibr.
struct ProjectionOfKalibr {
  std::string_view name;
  /// Its lens model; a pinhole has the model of its distortion.
  std::string_view lens;
  /// The parameters before fu fv pu pv, by their names in the lens model.
  Names parameters;
  /// The distortion_models that Kalibr combines with it.
  Names combined_with;
};

/// A distortion_model of Kalibr.
struct DistortionOfKalibr {
  std::string_view name;
  /// The lens model that it makes of a pinhole.
  std::string_view lens;
  Names parameters;
};

constexpr std::array<std::string_view, 4> kalibr_all{"none", "radtan", "equidistant", "fov"};

constexpr std::array<ProjectionOfKalibr, 4> kalibr_projections{
    {{"pinhole", {}, {}, kalibr_all},
     {"omni", "OMNI", kalibr_omni, Names(kalibr_all).first(2)},
     {"eucm", "EUCM", kalibr_eucm, Names(kalibr_all).first(1)},
     {"ds", "DOUBLE_SPHERE", kalibr_ds, Names(kalibr_all).first(1)}}};

constexpr std::array<DistortionOfKalibr, 4> kalibr_distortions{
    {{"none", "PINHOLE", {}},
     {"radtan", "OPENCV", kalibr_radtan},
     {"equidistant", "OPENCV_FISHEYE", kalibr_equidistant},
     {"fov", "FOV", kalibr_fov}}};

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

void read_kalibr_lens(const JsonValue& cam, ImportedCamera& one) {
  const JsonValue model = cam.at("distortion_model");
  const ProjectionOfKalibr& projection =
      model_of(cam.at("camera_model"), std::span<const ProjectionOfKalibr>(kalibr_projections));
  const DistortionOfKalibr& distortion =
      model_of(model, std::span<const DistortionOfKalibr>(kalibr_distortions));
  if (std::ranges::find(projection.combined_with, distortion.name) ==
      projection.combined_with.end())
    model.fail("Kalibr has no " + std::string(projection.name) + " with " +
               std::string(distortion.name));

  const std::size_t before = projection.parameters.size();
  const std::vector<double> intrinsics = cam.at("intrinsics").numbers(before + 4);
  set_intrinsics(one.camera.projection, std::span(intrinsics).last<4>());

  std::vector<LensNumber> numbers;
  add_numbers(intrinsics, projection.parameters, numbers);
  add_numbers(cam.at("distortion_coeffs").numbers(distortion.parameters.size()),
              distortion.parameters, numbers);
  set_lens(one, projection.lens.empty() ? distortion.lens : projection.lens, numbers, cam.where());
}

ExactPose from_first(const JsonValue& cam, const std::optional<ExactPose>& previous) {
  if (!previous) cam.fail("stands on the previous camera, whose pose has a fault");
  return composed(exact_pose(parse_matrix(cam.at("T_cn_cnm1"))), *previous);
}

RigCamera read_link(const JsonValue& cam, const std::string& name, const GivenLens& given,
                    const RigCamera* previous) {
  RigCamera link;
  link.camera = imported_camera(name, cam.where(), [&](ImportedCamera& one) {
    link.from_rig =
        previous ? from_first(cam, previous->from_rig) : exact_pose(one.camera.world_to_camera);
    const auto size = cam.at("resolution").elements(2);
    set_image(one.camera, given, [&] { return std::array{size[0], size[1]}; });
    read_kalibr_lens(cam, one);
  });
  return link;
}

/// The cameras cam0, cam1, … of the file; other keys are of no concern.
std::vector<RigCamera> read_chain(const JsonValue& root, const GivenLens& given) {
  std::vector<RigCamera> chain;
  for (;;) {
    const std::string name = "cam" + std::to_string(chain.size());
    const auto cam = root.find(name);
    if (!cam) break;
    chain.push_back(read_link(*cam, name, given, chain.empty() ? nullptr : &chain.back()));
  }
  if (chain.empty()) root.fail("has no camera: expected cam0, cam1, …");
  return chain;
}

}  // namespace

std::vector<ImportedCamera> cameras_of_kalibr(std::string_view json, const std::string& file,
                                              const GivenLens& given,
                                              const CalibrationPoses& poses) {
  const StandardArithmetic standard;
  const text::JsonDocument document(json, file);
  return at_poses(read_chain(document.root(), given), file, poses);
}

}  // namespace fathom
