#include "fathom/attribution/faults/storage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "fathom/attribution/model/named_models.h"
#include "tests/attribution/halfs.h"
#include "tests/attribution/hand_made.h"

namespace fathom::attribution {
namespace {

using Rounding = RecordedDepth::Rounding;
using testing::HasSubstr;

/// Depths at random, of near 0.5 and far 20.
Truth random_depths(double least = 1, double greatest = 9) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> depth(least, greatest);
  Truth truth = test::truth_of(40, 30, [&](std::uint32_t, std::uint32_t) { return depth(random); });
  truth.camera.near = 0.5;
  truth.camera.far = 20;
  return truth;
}

/// What another holds, as binary32.
OtherMap written(const Truth& truth, const std::function<double(double)>& stored) {
  OtherMap map = test::same_as(truth);
  for (double& depth : map.depths) depth = double{static_cast<float>(stored(depth))};
  return map;
}

std::optional<CoarseStorage> storage_of(const std::function<double(double)>& stored,
                                        const std::string& model = "gl-float32") {
  const Truth truth = random_depths();
  return coarse_storage(truth.camera, written(truth, stored), model_named(model));
}

std::function<double(double)> multiples(double per_unit) {
  return [=](double d) { return std::nearbyint(d * per_unit) / per_unit; };
}

struct Multiples {
  std::string name;
  double per_unit;
  const char* text;
};

void PrintTo(const Multiples& m, std::ostream* stream) {
  *stream << m.name;
}

class Storage : public testing::TestWithParam<Multiples> {};

TEST_P(Storage, OfMultiplesIsFound) {
  for (const char* model : {"gl-float32", "float32-ray"}) {
    const auto storage = storage_of(multiples(GetParam().per_unit), model);
    ASSERT_TRUE(storage);
    EXPECT_EQ(storage->text, GetParam().text);
    EXPECT_EQ(storage->recorded.rounding, Rounding::nearest);
    EXPECT_NEAR(storage->recorded.step * GetParam().per_unit, 1, 1e-6);
    EXPECT_EQ(storage->recorded.factor, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Storage,
    testing::Values(Multiples{"Millimetres", 1000,
                              "multiples of 0.001, whole millimetres if the scene is in metres"},
                    Multiples{"Centimetres", 100, "multiples of 0.01"},
                    Multiples{"Fivethousandths", 5000, "multiples of 0.0002"},
                    Multiples{"Kitti", 256, "multiples of 1/256"},
                    Multiples{"Whole", 1, "multiples of 1"},
                    // None of those that are tried by name.
                    Multiples{"Sevenths", 700, "multiples of 0.001428571"},
                    Multiples{"Odd", 1234.5, "multiples of 0.0008100446"}),
    [](const auto& m) { return m.param.name; });

TEST(CoarseStorage, HalfFloats) {
  const auto storage = storage_of([](double d) { return test::nearest_half(d); });
  ASSERT_TRUE(storage);
  EXPECT_EQ(storage->recorded.rounding, Rounding::binary16);
  EXPECT_EQ(storage->text, "half floats (binary16)");
}

// Between two powers of two halfs have one step: both are said.
TEST(CoarseStorage, HalfFloatsOfOneBinade) {
  const Truth truth = random_depths(4.1, 7.9);
  const auto storage =
      coarse_storage(truth.camera, written(truth, [](double d) { return test::nearest_half(d); }),
                     model_named("float32-ray"));
  ASSERT_TRUE(storage);
  EXPECT_EQ(storage->recorded.rounding, Rounding::binary16);
  EXPECT_EQ(storage->text, "half floats (binary16), or multiples of 1/256");
}

double window_of(double depth) {
  return 20 / 19.5 * (1 - 0.5 / depth);
}

TEST(CoarseStorage, CodesBetweenNearAndFar) {
  for (const int bits : {8, 16}) {
    const double greatest = std::exp2(bits) - 1;
    const auto window = storage_of([&](double d) {
      return 0.5 / (1 - std::nearbyint(window_of(d) * greatest) / greatest * 19.5 / 20);
    });
    ASSERT_TRUE(window) << bits;
    EXPECT_EQ(window->text, "window depths in " + std::to_string(bits) + " bits");
    EXPECT_EQ(window->recorded.term, DepthTerm::inverse);
    EXPECT_NEAR(window->recorded.exact(3), window_of(3), 1e-14);

    const auto linear = storage_of([&](double d) {
      return 0.5 + std::nearbyint((d - 0.5) / 19.5 * greatest) / greatest * 19.5;
    });
    ASSERT_TRUE(linear) << bits;
    EXPECT_EQ(linear->text, std::to_string(bits) + " bits from near to far");
    EXPECT_NEAR(linear->recorded.exact(20), 1, 1e-14);
  }
}

TEST(CoarseStorage, NoneOfNumbersAtRandom) {
  EXPECT_FALSE(storage_of([](double d) { return d; }));
  EXPECT_FALSE(storage_of([](double d) { return d; }, "float32-ray"));
  EXPECT_FALSE(storage_of([](double d) { return d * 1e-3; }, "float32-ray"));
}

// What the model stores itself is not coarse.
TEST(CoarseStorage, NotTheModelsOwn) {
  const auto codes = [](double d) {
    return 0.5 / (1 - std::nearbyint(window_of(d) * 65535) / 65535 * 19.5 / 20);
  };
  EXPECT_TRUE(storage_of(codes, "gl-unorm24"));
  EXPECT_FALSE(storage_of(codes, "gl-unorm16"));
}

// One depth, or three, are multiples of much.
TEST(CoarseStorage, NoneOfFewDepths) {
  EXPECT_FALSE(storage_of([](double) { return 2.5; }));
  EXPECT_FALSE(storage_of([](double d) { return d < 3 ? 2.5 : d < 6 ? 3.7123 : 5; }));
  const Truth truth = random_depths();
  OtherMap empty = test::same_as(truth);
  for (double& depth : empty.depths) depth = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(coarse_storage(truth.camera, empty, model_named("gl-float32")));
}

TEST(CoarseStorage, AllDepthsFit) {
  const Truth truth = random_depths();
  OtherMap map = written(truth, multiples(1000));
  map.depths[17] += 0.00037;
  EXPECT_FALSE(coarse_storage(truth.camera, map, model_named("gl-float32")));
}

TEST(RoundedDown, IsToldFromNearest) {
  const Truth truth = random_depths();
  const RecordedDepth recorded{.rounding = Rounding::nearest, .step = 0.001};
  const auto down = [](double d) { return std::floor(d * 1000) / 1000; };
  EXPECT_TRUE(is_rounded_down(truth, written(truth, down), recorded));
  EXPECT_FALSE(is_rounded_down(truth, written(truth, multiples(1000)), recorded));
  // An offset of more than a step is not a rounding.
  const auto lower = [](double d) { return std::nearbyint(d * 1000 - 1.4) / 1000; };
  EXPECT_FALSE(is_rounded_down(truth, written(truth, lower), recorded));
  OtherMap with_holes = written(truth, down);
  for (std::size_t i = 0; i < 200; ++i) with_holes.depths[i] = i < 100 ? 15 : INFINITY;
  EXPECT_TRUE(is_rounded_down(truth, with_holes, recorded));
}

// 3·10⁻⁶ away from 1/971, which thousands of steps tell from it.
TEST(CommonStep, IsNotAPartOfOneThatItComesCloseTo) {
  const double step = 0.001029862956521739;
  std::vector<double> values;
  for (int k = 3400; k < 4400; ++k) values.push_back(static_cast<float>(k * step));
  const auto found = common_step(values);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found / step, 1, 1e-7);
}

TEST(CommonStep, IsTheCoarsest) {
  std::vector<double> values;
  for (int k = 40; k < 100; k += 2) values.push_back(0.3 * k);
  for (const int k : {101, 107, 113}) values.push_back(0.3 * k);
  const auto step = common_step(values);
  ASSERT_TRUE(step);
  EXPECT_NEAR(*step, 0.3, 1e-9);
  values.resize(30);
  ASSERT_TRUE(common_step(values));
  EXPECT_NEAR(*common_step(values), 0.6, 1e-9);
  values.resize(23);  // too few to say
  EXPECT_FALSE(common_step(values));
}

}  // namespace
}  // namespace fathom::attribution
