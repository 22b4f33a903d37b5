// Kalibr's cameras project as its own classes do (`ethz-asl/kalibr`: aslam_cameras):
// OmniProjection, ExtendedUnifiedProjection, DoubleSphereProjection, RadialTangentialDistortion,
// EquidistantDistortion and FovDistortion, with the order of numbers of its ConfigReader.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "fathom/camera/data_set_cameras.h"
#include "fathom/failures/errors.h"
#include "tests/camera/imported_rays.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::string cam(const std::string& model, const std::string& intrinsics,
                const std::string& distortion, const std::string& coefficients,
                const std::string& more = "") {
  return R"({"camera_model": ")" + model + R"(", "intrinsics": [)" + intrinsics +
         R"(], "distortion_model": ")" + distortion + R"(", "distortion_coeffs": [)" +
         coefficients + R"(], "resolution": [8, 6], "rostopic": "/cam0/image_raw")" + more + "}";
}

const std::string pinhole = cam("pinhole", "5, 6, 3.25, 2.5", "none", "");

std::vector<ImportedCamera> import_calibration(const std::string& json,
                                               const CalibrationPoses& poses = {}) {
  return cameras_of_kalibr(json, "camchain.yaml", {}, poses);
}

ImportedCamera first_of(const std::string& cam0) {
  return import_calibration(R"({"cam0": )" + cam0 + "}").at(0);
}

Camera valid(const ImportedCamera& one) {
  EXPECT_EQ(one.fault + one.absence + one.distortion, "");
  return one.camera;
}

double length(const Direction& d) {
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

PixelPoint radtan(const PixelPoint& m, const std::array<double, 4>& k) {
  const double q = m[0] * m[0] + m[1] * m[1], radial = k[0] * q + k[1] * q * q;
  return {m[0] + m[0] * radial + 2 * k[2] * m[0] * m[1] + k[3] * (q + 2 * m[0] * m[0]),
          m[1] + m[1] * radial + 2 * k[3] * m[0] * m[1] + k[2] * (q + 2 * m[1] * m[1])};
}

/// With fu fv pu pv = 5, 6, 3.25, 2.5.
PixelPoint in_image(const PixelPoint& m) {
  return {5 * m[0] + 3.25, 6 * m[1] + 2.5};
}

PixelPoint on_plane(const Direction& d) {
  return {d[0] / d[2], d[1] / d[2]};
}

TEST(ImportKalibr, PinholesAreTakenAsTheyAre) {
  const Camera camera = valid(first_of(pinhole));
  EXPECT_EQ(camera.name, "cam0");
  EXPECT_EQ(camera.width, 8U);
  EXPECT_EQ(camera.height, 6U);
  EXPECT_EQ(camera.projection.pixel_centre, 0);
  EXPECT_EQ(camera.projection.lens, std::nullopt);
  EXPECT_EQ(camera.world_to_camera, Camera().world_to_camera);
  expect_rays(camera, 0, [](const Direction& d) { return in_image(on_plane(d)); });
  EXPECT_EQ(valid(first_of(cam("pinhole", "5, 6, 3.25, 2.5", "radtan", "0, 0, 0, 0"))).projection,
            camera.projection);
}

TEST(ImportKalibr, PinholesHaveThreeDistortions) {
  const std::string K = "5, 6, 3.25, 2.5";
  expect_rays(valid(first_of(cam("pinhole", K, "radtan", "-0.1, 0.02, 0.003, -0.004"))), 0,
              [](const Direction& d) {
                return in_image(radtan(on_plane(d), {-0.1, 0.02, 0.003, -0.004}));
              });
  expect_rays(valid(first_of(cam("pinhole", K, "equidistant", "0.01, -0.02, 0.03, -0.004"))), 0,
              [](const Direction& d) {
                const PixelPoint m = on_plane(d);
                const double r = std::hypot(m[0], m[1]), theta = std::atan(r), t = theta * theta;
                const double scale =
                    theta *
                    (1 + 0.01 * t - 0.02 * t * t + 0.03 * t * t * t - 0.004 * t * t * t * t) / r;
                return in_image({m[0] * scale, m[1] * scale});
              });
  const ImportedCamera fov = first_of(cam("pinhole", K, "fov", "0.9"));
  if (lens_model_named("FOV")) {
    expect_rays(valid(fov), 0, [](const Direction& d) {
      const PixelPoint m = on_plane(d);
      const double r = std::hypot(m[0], m[1]),
                   scale = std::atan(2 * std::tan(0.45) * r) / (0.9 * r);
      return in_image({m[0] * scale, m[1] * scale});
    });
  } else {
    EXPECT_EQ(fov.absence, "camchain.yaml: cam0: the lens model FOV is not available");
  }
}

TEST(ImportKalibr, OmniBeginsWithXi) {
  const auto on_mirror = [](const Direction& d) {
    const double w = d[2] + 1.5 * length(d);
    return PixelPoint{d[0] / w, d[1] / w};
  };
  const std::string numbers = "1.5, 5, 6, 3.25, 2.5";
  const Camera camera = valid(first_of(cam("omni", numbers, "none", "")));
  expect_rays(camera, 0, [&](const Direction& d) { return in_image(on_mirror(d)); });
  EXPECT_EQ(valid(first_of(cam("omni", numbers, "radtan", "0, 0, 0, 0"))).projection,
            camera.projection);
  const ImportedCamera bent = first_of(cam("omni", numbers, "radtan", "-0.1, 0.02, 0.003, -0.004"));
  if (entry_of(LensModel::omni).distortion.size() > 1) {
    expect_rays(valid(bent), 0, [&](const Direction& d) {
      return in_image(radtan(on_mirror(d), {-0.1, 0.02, 0.003, -0.004}));
    });
  } else {
    EXPECT_EQ(bent.absence, "camchain.yaml: cam0: the lens model OMNI has no parameter k1");
  }
}

TEST(ImportKalibr, EucmBeginsWithAlphaAndBeta) {
  expect_rays(valid(first_of(cam("eucm", "0.6, 1.2, 5, 6, 3.25, 2.5", "none", ""))), 0,
              [](const Direction& p) {
                const double d = std::sqrt(1.2 * (p[0] * p[0] + p[1] * p[1]) + p[2] * p[2]);
                const double w = 0.6 * d + 0.4 * p[2];
                return in_image({p[0] / w, p[1] / w});
              });
}

TEST(ImportKalibr, DoubleSphereBeginsWithXiAndAlpha) {
  expect_rays(valid(first_of(cam("ds", "-0.2, 0.6, 5, 6, 3.25, 2.5", "none", ""))), 0,
              [](const Direction& p) {
                const double k = -0.2 * length(p) + p[2];
                const double d2 = std::sqrt(p[0] * p[0] + p[1] * p[1] + k * k);
                const double w = 0.6 * d2 + 0.4 * k;
                return in_image({p[0] / w, p[1] / w});
              });
}

/// [A | b] as a list of 4 rows.
std::string rows_of(const Pose& pose) {
  std::string rows;
  for (const auto& row : pose) rows += "[" + joined(row, ", ") + "], ";
  return "[" + rows + "[0, 0, 0, 1]]";
}

std::string chain_of(const std::vector<Pose>& steps) {
  std::string json = R"({"cam0": )" + pinhole;
  for (std::size_t n = 0; n < steps.size(); ++n)
    json += R"(, "cam)" + std::to_string(n + 1) + R"(": )" +
            cam("pinhole", "5, 6, 3.25, 2.5", "none", "", R"(, "T_cn_cnm1": )" + rows_of(steps[n]));
  return json + "}";
}

/// A quarter turn about y and a step: exact in binary64.
constexpr Pose quarter{{{0, 0, 1, 2}, {0, 1, 0, 3}, {-1, 0, 0, 4}}};
constexpr Pose step{{{1, 0, 0, 0.5}, {0, 1, 0, 0}, {0, 0, 1, -8}}};
/// step after quarter
constexpr Pose both{{{0, 0, 1, 2.5}, {0, 1, 0, 3}, {-1, 0, 0, -4}}};

// T_cn_cnm1 takes points from camera n − 1 to camera n.
TEST(ImportKalibr, EachCameraStandsOnThePreviousOne) {
  const auto cameras = judged(import_calibration(chain_of({quarter, step})));
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].camera.world_to_camera, Camera().world_to_camera);
  EXPECT_EQ(cameras[1].camera.world_to_camera, quarter);
  EXPECT_EQ(cameras[2].camera.world_to_camera, both);
  EXPECT_EQ(cameras[2].camera.name, "cam2");
}

TEST(ImportKalibr, ChainsOfMoreThanTenCamerasAreInOrder) {
  const auto cameras = judged(import_calibration(chain_of(std::vector<Pose>(11, step))));
  ASSERT_EQ(cameras.size(), 12U);
  for (int n = 0; n < 12; ++n) {
    EXPECT_EQ(cameras[n].camera.name, "cam" + std::to_string(n));
    EXPECT_EQ(cameras[n].camera.world_to_camera[2][3], -8 * n);
  }
}

TEST(ImportKalibr, PosesMoveTheWholeRig) {
  const auto cameras =
      judged(import_calibration(chain_of({step}), {{{"a", quarter}, {"b", step}}}));
  ASSERT_EQ(cameras.size(), 4U);
  EXPECT_EQ(cameras[0].camera.name, "cam0/a");
  EXPECT_EQ(cameras[0].camera.world_to_camera, quarter);
  EXPECT_EQ(cameras[1].camera.name, "cam1/a");
  EXPECT_EQ(cameras[1].camera.world_to_camera, both);
  EXPECT_EQ(cameras[3].camera.name, "cam1/b");
  const Pose inverse{{{0, 0, -1, 4}, {0, 1, 0, -3}, {1, 0, 0, -2}}};
  const auto inverted = judged(
      import_calibration(chain_of({quarter}), {{{"a", inverse}}, PoseDirection::camera_to_world}));
  EXPECT_EQ(inverted[0].camera.world_to_camera, quarter);
}

// Numbers of 29 bits: products of two have 58, and sums of four fit a long double of 64 bits, so
// that its conversion is the only rounding.
TEST(ImportKalibr, ProductsAreRoundedOnce) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> draw(-(1 << 28), 1 << 28);
  int rounded = 0;
  for (int round = 0; round < 50; ++round) {
    Pose first, second, product;
    for (auto* pose : {&first, &second})
      for (auto& row : *pose)
        for (double& entry : row) entry = std::ldexp(draw(random), -26);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        Real sum = k == 3 ? second[i][3] : 0;
        for (std::size_t j = 0; j < 3; ++j) sum += Real(second[i][j]) * first[j][k];
        product[i][k] = static_cast<double>(sum);
        if (Real(product[i][k]) != sum) ++rounded;
      }
    }
    EXPECT_EQ(judged(import_calibration(chain_of({first, second}))).at(2).camera.world_to_camera,
              product);
  }
  EXPECT_GT(rounded, 300);
}

TEST(ImportKalibr, FaultsAreNamed) {
  const auto fault = [](const std::string& cam0) { return first_of(cam0).fault; };
  const std::string K = "5, 6, 3.25, 2.5";
  EXPECT_EQ(fault(cam("fisheye", K, "none", "")),
            "camchain.yaml: cam0.camera_model: found fisheye, expected pinhole, omni, eucm or ds");
  EXPECT_THAT(
      fault(cam("pinhole", K, "equi", "")),
      HasSubstr("cam0.distortion_model: found equi, expected none, radtan, equidistant or fov"));
  EXPECT_THAT(fault(cam("ds", "0.1, 0.5, " + K, "radtan", "0, 0, 0, 0")),
              HasSubstr("cam0.distortion_model: Kalibr has no ds with radtan"));
  EXPECT_THAT(fault(cam("omni", "1, " + K, "equidistant", "0, 0, 0, 0")),
              HasSubstr("Kalibr has no omni with equidistant"));
  EXPECT_THAT(fault(cam("ds", K, "none", "")), HasSubstr("cam0.intrinsics: expected"));
  EXPECT_THAT(fault(cam("pinhole", K, "radtan", "0, 0, 0")),
              HasSubstr("cam0.distortion_coeffs: expected"));
  EXPECT_THAT(fault(cam("pinhole", R"(5, 6, 3.25, ".nan")", "none", "")),
              HasSubstr("cam0.intrinsics[3]: is a string, expected a number"));
  EXPECT_THAT(fault(cam("eucm", "1.5, 1, " + K, "none", "")),
              HasSubstr("camchain.yaml: cam0: alpha is not between 0 and 1"));
  EXPECT_THAT(fault("{}"), HasSubstr("camchain.yaml: cam0: the key"));
  EXPECT_THAT(message_of<InputError>([] { import_calibration("{}"); }),
              HasSubstr("camchain.yaml: has no camera: expected cam0, cam1, …"));
}

TEST(ImportKalibr, FaultsOfPosesBelongToTheirCameras) {
  const std::string alone =
      R"({"cam0": )" + pinhole + R"(, "cam1": )" + pinhole + R"(, "cam2": )" + pinhole + "}";
  const auto cameras = import_calibration(alone);
  ASSERT_EQ(cameras.size(), 3U);
  EXPECT_EQ(cameras[0].fault, "");
  EXPECT_THAT(cameras[1].fault, HasSubstr("cam1: the key \"T_cn_cnm1\" is missing"));
  EXPECT_THAT(cameras[2].fault,
              HasSubstr("cam2: stands on the previous camera, whose pose has a fault"));
  const Pose flat{{{1, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 1, 0}}};
  EXPECT_THAT(import_calibration(chain_of({flat})).at(1).fault, HasSubstr("camchain.yaml: "));
  EXPECT_THAT(
      import_calibration(chain_of({}), {{{"0", flat}}, PoseDirection::camera_to_world}).at(0).fault,
      HasSubstr("the matrix is singular"));
  Pose endless = step;
  endless[0][3] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(import_calibration(chain_of({}), {{{"0", endless}}}).at(0).fault,
              HasSubstr("the pose has a number that is not finite"));
}

}  // namespace
}  // namespace fathom
