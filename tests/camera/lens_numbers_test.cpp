// Lenses from names and numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fathom/camera/lens.h"
#include "fathom/failures/errors.h"

namespace fathom {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

std::string fault(std::string_view model, const std::vector<double>& numbers,
                  double max_radius = 1) {
  try {
    lens_of_numbers(model, numbers, max_radius);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

TEST(LensNumbers, KeepTheirOrderAndTheRestIsZero) {
  const std::array<double, 5> numbers{-0.25, 0.06, 0.001, -0.0005, 0.01};
  const Lens lens = lens_of_numbers("OPENCV_14", numbers, 0.75);
  EXPECT_EQ(lens, (Lens{LensModel::opencv_14, {-0.25, 0.06, 0.001, -0.0005, 0.01}, 0.75}));
  EXPECT_EQ(lens_of_numbers("FISHEYE_STEREOGRAPHIC", {}), Lens{LensModel::fisheye_stereographic});
}

TEST(LensNumbers, EveryModelTakesItsOwnCount) {
  for (const LensModelEntry& entry : lens_models()) {
    const std::vector<double> numbers(entry.distortion.size(), 0.125);
    EXPECT_EQ(distortion_count_fault(entry, numbers.size()), std::nullopt) << entry.name;
    EXPECT_NE(distortion_count_fault(entry, numbers.size() + 1), std::nullopt) << entry.name;
    EXPECT_EQ(distortion_count_fault(entry, numbers.size() + 4, 4), std::nullopt) << entry.name;
  }
}

// As the specification has them; files, importers and C take keys and lists from the same table.
TEST(LensModels, HaveTheirParametersInOrder) {
  const std::array<std::string, 29> rows{
      "SIMPLE_PINHOLE f cx cy",
      "PINHOLE fx fy cx cy",
      "SIMPLE_RADIAL f cx cy k",
      "RADIAL f cx cy k1 k2",
      "OPENCV fx fy cx cy k1 k2 p1 p2",
      "FULL_OPENCV fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6",
      "OPENCV_14 fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tauX tauY",
      "BROWN fx fy cx cy k1 k2 k3 k4 p1 p2",
      "FOV fx fy cx cy omega",
      "SIMPLE_DIVISION f cx cy k",
      "DIVISION fx fy cx cy k",
      "FISHEYE_STEREOGRAPHIC fx fy cx cy",
      "SIMPLE_FISHEYE f cx cy",
      "FISHEYE fx fy cx cy",
      "SIMPLE_RADIAL_FISHEYE f cx cy k",
      "RADIAL_FISHEYE f cx cy k1 k2",
      "OPENCV_FISHEYE fx fy cx cy k1 k2 k3 k4",
      "THIN_PRISM_FISHEYE fx fy cx cy k1 k2 p1 p2 k3 k4 sx1 sy1",
      "RAD_TAN_THIN_PRISM_FISHEYE fx fy cx cy k0 k1 k2 k3 k4 k5 p0 p1 s0 s1 s2 s3",
      "FISHEYE_ORTHOGRAPHIC fx fy cx cy",
      "FISHEYE_EQUISOLID fx fy cx cy",
      "UCM fx fy cx cy alpha",
      "EUCM fx fy cx cy alpha beta",
      "DOUBLE_SPHERE fx fy cx cy xi alpha",
      "OMNI fx fy cx cy xi k1 k2 p1 p2",
      "FTHETA fx fy cx cy p0 p1 p2 p3 p4 p5",
      "EQUIRECTANGULAR w h cx cy",
      "CYLINDRICAL w fy cx cy",
      "TABLE"};
  std::vector<std::string> found;
  for (const LensModelEntry& entry : lens_models()) {
    std::string& row = found.emplace_back(entry.name);
    for (const auto& names : {entry.intrinsics, entry.distortion})
      for (const std::string_view name : names) row += ' ' + std::string(name);
  }
  EXPECT_THAT(found, ElementsAreArray(rows));
}

TEST(LensModels, OfThePlaneHaveNearAndFarOfZ) {
  for (const LensModelEntry& entry : lens_models()) {
    EXPECT_EQ(is_plane(entry.model), entry.model < LensModel::simple_division) << entry.name;
    EXPECT_EQ(lens_model_named(entry.name), entry.model);
  }
}

TEST(LensModels, OpencvAndOmniHaveShorterLists) {
  for (const LensModelEntry& entry : lens_models()) {
    std::vector<std::size_t> counts;
    for (std::size_t count = 0; count < 20; ++count)
      if (!distortion_count_fault(entry, count)) counts.push_back(count);
    std::vector<std::size_t> expected{entry.distortion.size()};
    if (entry.model == LensModel::opencv_14) expected = {4, 5, 8, 12, 14};
    if (entry.model == LensModel::omni) expected = {1, 5};
    EXPECT_EQ(counts, expected) << entry.name;
  }
}

TEST(LensNumbers, FaultsAreNamed) {
  EXPECT_THAT(fault("OPENC", {}), HasSubstr("unknown lens model 'OPENC', expected SIMPLE_PINHOLE"));
  EXPECT_THAT(fault("OPENC", {}), HasSubstr("did you mean 'OPENCV'?"));
  EXPECT_EQ(fault("OPENCV", {1, 2, 3}), "found 3 numbers, OPENCV has 4: k1, k2, p1, p2");
  EXPECT_THAT(fault("OPENCV_14", {1}),
              HasSubstr("found 1 number, OPENCV_14 has 4, 5, 8, 12 or 14: k1, k2, p1, p2, k3"));
  EXPECT_EQ(fault("RADIAL", {1, std::numeric_limits<double>::infinity()}),
            "k2 is not a finite number");
  EXPECT_EQ(fault("RADIAL", {1, 2}, 0), "max_radius is not greater than 0");
  EXPECT_EQ(fault("FOV", {std::nextafter(-3.141592653589793, -4)}),
            "omega is not between -pi and pi");
  EXPECT_EQ(fault("FOV", {3.141592653589793}), "none");
  EXPECT_EQ(fault("FTHETA", {-3.5, 1, 0, 0, 0, 0}), "p0 is not between -pi and pi");
  for (const std::vector<double>& falls :
       {std::vector<double>{0, 0, 0, 0, 0, 0}, {1, -1, 1, 1, 1, 1}, {0, 0, 0, -1e-300, 1, 0}})
    EXPECT_EQ(fault("FTHETA", falls), "the angle does not grow with the distance from the axis");
  EXPECT_EQ(fault("FTHETA", {0, 0, 0, 1e-300, -1, 0}), "none");
  EXPECT_EQ(fault("UCM", {-1e-300}), "alpha is not between 0 and 1");
  EXPECT_EQ(fault("EUCM", {std::nextafter(1.0, 2.0), 1}), "alpha is not between 0 and 1");
  EXPECT_EQ(fault("EUCM", {1, 0}), "beta is not greater than 0");
  EXPECT_EQ(fault("EUCM", {0, std::numeric_limits<double>::quiet_NaN()}),
            "beta is not a finite number");
  EXPECT_EQ(fault("OMNI", {-0.125}), "xi is less than 0");
  EXPECT_EQ(fault("DOUBLE_SPHERE", {-1, 0.5}), "xi is not between -1 and 1");
  EXPECT_EQ(fault("DOUBLE_SPHERE", {0.5, 2}), "alpha is not between 0 and 1");
  EXPECT_EQ(fault("DOUBLE_SPHERE", {-0.5, 1}), "none");
  EXPECT_EQ(fault("EUCM", {1, 1e-300}), "none");
}

}  // namespace
}  // namespace fathom
