// AliceVision's cameras project as its sources do: u = scale·(x, y)/z + w/2 + offset of
// (x, y, z) = R·(X − c), R column by column, pixel centres at integers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A file of one view. Boost writes every number as a string.
std::string file(const std::string& version, const std::string& intrinsic,
                 const std::string& view = R"("path": "/data/photos/IMG_1.JPG")") {
  return R"({"version": [)" + version + R"(], "views": [{"viewId": "7", "poseId": "8",
      "intrinsicId": "9", )" +
         view + R"(}], "intrinsics": [{"intrinsicId": "9", "width": "4092", "height": "2048",
      "sensorWidth": "36", "sensorHeight": "24", )" +
         intrinsic + R"(}], "poses": [{"poseId": "8", "pose": {"transform": {
      "rotation": ["0", "0", "1", "0", "1", "0", "-1", "0", "0"],
      "center": ["0.5", "-0.25", "2"]}, "locked": "0"}}]})";
}

std::vector<ImportedCamera> sfm(const std::string& text) {
  return judged(parse_sfm_data({text, "cameras.sfm"}));
}

/// The pose above: the rows of R are (0, 0, −1), (0, 1, 0), (1, 0, 0).
Vector in_camera(const Vector& X) {
  return {-(X[2] - 2), X[1] + 0.25L, X[0] - 0.5L};
}

void expect_seen(const Camera& camera, Real fx, Real fy, Real cx, Real cy) {
  for (const Vector& X : {Vector{4, 1, 2}, Vector{8, -2, 1}}) {
    const Vector p = in_camera(X);
    expect_same(seen(camera, X),
                {fx * p[0] / p[2] + cx + 0.5L, fy * p[1] / p[2] + cy + 0.5L, p[2]});
  }
}

const std::string plain = R"("type": "pinhole", "distortionType": "none",
      "undistortionType": "none", "distortionParams": "", )";

/// The same camera, 1000 and 2000 pixels and (2020, 1040), as each version writes it: the files
/// that AliceVision keeps to test its own reading (src/aliceVision/sfmDataIO/compatibilityData).
TEST(ImportSfmData, FocalLengthsAndPrincipalPointsOfEachVersion) {
  const std::string offset = R"("principalPoint": ["-26", "16"])";
  const auto camera = [](const std::string& version, const std::string& intrinsic) {
    return sfm(file(version, intrinsic)).at(0).camera;
  };
  expect_seen(camera(R"("1", "0", "0")", R"("type": "pinhole", "pxFocalLength": "1000",
      "principalPoint": ["2020", "1040"])"),
              1000, 1000, 2020, 1040);
  expect_seen(camera(R"("1", "2", "0")", R"("type": "pinhole",
      "pxFocalLength": ["1000", "2000"], "principalPoint": ["2020", "1040"])"),
              1000, 2000, 2020, 1040);
  expect_seen(camera(R"("1", "2", "1")",
                     R"("type": "pinhole", "pxFocalLength": ["1000", "2000"], )" + offset),
              1000, 2000, 2020, 1040);
  // In millimetres, 36·1000/4092; until 1.2.5 the ratio is fx/fy, until 1.2.11 fy/fx.
  const std::string focal = R"("focalLength": "8.797653958944281", )";
  expect_seen(
      camera(R"("1", "2", "4")", R"("type": "pinhole", "pixelRatio": "0.5", )" + focal + offset),
      1000, 2000, 2020, 1040);
  expect_seen(camera(R"("1", "2", "8")", plain + R"("pixelRatio": "2", )" + focal + offset), 1000,
              2000, 2020, 1040);
  // From then on the focal length is that of y.
  expect_seen(camera(R"(1, 2, 11)", plain + R"("pixelRatio": "2",
      "focalLength": 17.595307917888562, )" +
                                        offset),
              1000, 2000, 2020, 1040);
}

const std::string usual = R"("focalLength": "10", "principalPoint": ["0", "0"])";

TEST(ImportSfmData, DistortionIsTold) {
  const auto distortion = [](const std::string& version, const std::string& lens) {
    return sfm(file(version, lens + usual)).at(0).distortion;
  };
  const std::string now = R"("1", "2", "11")", before = R"("1", "2", "6")";
  EXPECT_EQ(distortion(now, plain), "");
  const auto lens = [](const char* type, const char* numbers, const char* other = "none") {
    return std::string(R"("type": "pinhole", "distortionType": ")") + type +
           R"(", "undistortionType": ")" + other + R"(", "distortionParams": [)" + numbers + "], ";
  };
  EXPECT_EQ(distortion(now, lens("radialk3", R"("0", "0", "0")")), "");
  EXPECT_THAT(distortion(now, lens("radialk3", R"("0", "1e-9", "0")")), HasSubstr("radialk3"));
  EXPECT_THAT(distortion(now, lens("none", "", "3deanamorphic4")), HasSubstr("3deanamorphic4"));
  EXPECT_THAT(distortion(before, R"("type": "radial3", "distortionParams": ["0.1"], )"),
              HasSubstr("cameras.sfm: intrinsics[0]: the lens radial3 has distortion"));
  const auto fault = [&](const std::string& version, const std::string& text) {
    return message_of<InputError>([&] { distortion(version, text); });
  };
  EXPECT_THAT(fault(now, lens("fisheye", "")), HasSubstr("the lens fisheye is no pinhole camera"));
  EXPECT_THAT(fault(before, R"("type": "fisheye4", )"), HasSubstr("no pinhole camera"));
  EXPECT_THAT(fault(now, R"("type": "equidistant", )"), HasSubstr("no pinhole camera"));
}

TEST(ImportSfmData, NamesAreThePathsBelowTheCommonFolder) {
  const auto names = [](const std::vector<std::string>& paths) {
    std::string views;
    for (std::size_t i = 0; i < paths.size(); ++i)
      views += std::string(i == 0 ? "" : ",") + R"({"viewId": ")" + std::to_string(i) +
               R"(", "intrinsicId": "9", "path": ")" + paths[i] + "\"}";
    std::vector<std::string> result;
    for (const auto& one : parse_sfm_data(
             {R"({"version": ["1","2","11"], "views": [)" + views + "]}", "cameras.sfm"}))
      result.push_back(one.camera.name);
    return result;
  };
  EXPECT_THAT(names({"/a/b/1.jpg"}), ElementsAre("1.jpg"));
  EXPECT_THAT(names({"/a/b/1.jpg", "/a/b/2.jpg"}), ElementsAre("1.jpg", "2.jpg"));
  EXPECT_THAT(names({"/a/left/1.jpg", "/a/right/1.jpg"}), ElementsAre("left/1.jpg", "right/1.jpg"));
  EXPECT_THAT(names({"/a/1.jpg", "/a/b/1.jpg"}), ElementsAre("1.jpg", "b/1.jpg"));
  EXPECT_THAT(names({"D:/x/1.jpg", "2.jpg"}), ElementsAre("D:/x/1.jpg", "2.jpg"));
  EXPECT_THAT(names({"", "/a/b/1.jpg"}), ElementsAre("0", "/a/b/1.jpg"));
  EXPECT_THAT(message_of<InputError>([&] {
                names({"/a/1.jpg", "/a/1.jpg"});
              }),
              HasSubstr("two images have the name '1.jpg'"));
}

TEST(ImportSfmData, ViewsThatWereNotReconstructedAreAbsent) {
  const std::string text = R"({"version": ["1","2","11"], "views": [{"viewId": "1",
      "intrinsicId": "9", "poseId": "1", "path": "/a.jpg"}]})";
  const auto cameras = parse_sfm_data({text, "cameras.sfm"});
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].absence,
            "cameras.sfm: views[0]: the view was not reconstructed: it has no pose");
}

TEST(ImportSfmData, NamesPlaceAndFault) {
  const auto fault = [](const std::string& text) {
    return message_of<InputError>([&] { sfm(text); });
  };
  const std::string now = R"("1", "2", "11")";
  EXPECT_THAT(fault("{}"), HasSubstr("cameras.sfm: the key \"version\" is missing"));
  EXPECT_THAT(fault(file(R"("1", "2", "12")", plain + usual)),
              HasSubstr("version: expected 1.0.0 to 1.2.11"));
  EXPECT_THAT(fault(R"({"version": ["1","2","11"], "views": ""})"), HasSubstr("there is no view"));
  EXPECT_THAT(fault(file(now, plain + R"("focalLength": "x", "principalPoint": ["0", "0"])")),
              HasSubstr("intrinsics[0].focalLength: expected a number, found 'x'"));
  EXPECT_THAT(fault(file(now, plain + R"("focalLength": "nan", "principalPoint": ["0", "0"])")),
              HasSubstr("expected a finite number"));
  EXPECT_THAT(fault(file(now, plain + R"("focalLength": "0", "principalPoint": ["0", "0"])")),
              HasSubstr("intrinsics[0]: fx is 0"));
  EXPECT_THAT(fault(file(now, plain + usual + R"(, "pixelRatio": "0")")),
              HasSubstr("expected a positive pixelRatio"));
  EXPECT_THAT(fault(file(now, plain + usual, R"("path": "/a.jpg", "rigId": "3")")),
              HasSubstr("views[0]: the view belongs to a rig"));
  EXPECT_EQ(sfm(file(now, plain + usual,
                     R"("path": "/a.jpg", "rigId": "3", "isPoseIndependant": "true")"))
                .size(),
            1U);
}

}  // namespace
}  // namespace fathom
