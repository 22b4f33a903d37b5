#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_choice.h"
#include "tests/attribution/sphere_maps.h"
#include "tests/effort.h"

/// Right maps in which a few pixels are wrong: these pixels are blamed and no others, whatever
/// model is named.
namespace fathom::attribution {
namespace {

constexpr double near = 0.1, far = 20;

struct Stray {
  std::string name;
  double (*of)(double depth);
};

std::vector<Stray> strays() {
  using Limits = std::numeric_limits<double>;
  return {{"Scaled", [](double depth) { return double{static_cast<float>(1.03 * depth)}; }},
          {"Negative", [](double) { return -1.0; }},
          {"Greatest16", [](double) { return 65504.0; }},
          {"BeyondFar", [](double) { return 1.5 * far; }},
          {"NaN", [](double) { return Limits::quiet_NaN(); }},
          {"Hole", [](double) { return Limits::infinity(); }}};
}

struct RightMap {
  std::string model;
  OtherMap map;
};

RightMap right_map(const Truth& truth, const std::string& model) {
  if (model == "gl-unorm16") return {model, test::in_codes(truth, 16, near, far)};
  if (model == "gl-unorm24") return {model, test::in_codes(truth, 24, near, far)};
  return {model, test::in_binary32(truth)};
}

/// `count` pixels, apart from each other, where the model is certain of the surface.
std::vector<std::size_t> sure_pixels(const Truth& truth, const RightMap& right, std::size_t count) {
  const Attribution found = attribute(truth, right.map, model_named(right.model));
  const std::size_t width = truth.camera.width;
  std::vector<std::size_t> sure;
  for (std::size_t i = 0; i < found.clues.alone.size(); ++i) {
    if (found.clues.alone[i] != 0 && i / width % 3 == 0 && i % width % 3 == 0) sure.push_back(i);
  }
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(sure[(2 * k + 1) * sure.size() / (2 * count)]);
  return chosen;
}

const std::vector<std::string> drawing{"gl-unorm16", "gl-unorm24", "float32-ray"};
const std::vector<std::string> named{"", "gl-unorm16", "gl-unorm24", "float32-ray"};
const std::vector<std::size_t> counts{1, 2, 10, 100};

/// Indices into `drawing`, strays() and `counts`. Their sum chooses the model that judges.
using StrayCase = std::tuple<std::size_t, std::size_t, std::size_t>;

std::size_t sum_of(const StrayCase& made) {
  const auto [drew, stray, many] = made;
  return drew + stray + many;
}

/// All combinations, or the third of them whose sums are multiples of 3, which has each pair of two
/// of the three.
std::vector<StrayCase> stray_cases() {
  std::vector<StrayCase> cases;
  for (std::size_t drew = 0; drew < drawing.size(); ++drew) {
    for (std::size_t stray = 0; stray < strays().size(); ++stray) {
      for (std::size_t many = 0; many < counts.size(); ++many) {
        const StrayCase made{drew, stray, many};
        if (checks::draws_all_cases() || sum_of(made) % 3 == 0) cases.push_back(made);
      }
    }
  }
  return cases;
}

class StrayPixels : public ::testing::TestWithParam<StrayCase> {
 protected:
  static void SetUpTestSuite() { truth = test::sphere_seen_by(test::sphere_camera(near, far)); }
  static void TearDownTestSuite() { truth.reset(); }

  static std::shared_ptr<const Truth> truth;
};
std::shared_ptr<const Truth> StrayPixels::truth;

// The number of strays decides which model is named, or that none is.
TEST_P(StrayPixels, AloneAreBlamed) {
  const auto [drew, stray, many] = GetParam();
  const RightMap right = right_map(*truth, drawing[drew]);
  OtherMap map = right.map;
  std::vector<std::uint8_t> is_stray(map.depths.size());
  for (const std::size_t i : sure_pixels(*truth, right, counts[many])) {
    map.depths[i] = map.values[i] = strays()[stray].of(map.depths[i]);
    is_stray[i] = 1;
  }
  const std::string& name = named[sum_of(GetParam()) % named.size()];
  std::optional<RendererModel> model;
  if (!name.empty()) model = model_named(name);
  const Judgement found = judge(truth, map, model);
  std::uint64_t missed = 0, blamed = 0;
  for (std::size_t i = 0; i < is_stray.size(); ++i) {
    const bool is_blamed = found.attribution.classes[i] == PixelClass::unexplained;
    missed += is_stray[i] != 0 && !is_blamed ? 1 : 0;
    blamed += is_stray[i] == 0 && is_blamed ? 1 : 0;
  }
  EXPECT_EQ(missed, 0U) << name << ", taken for " << found.model.name;
  EXPECT_EQ(blamed, 0U) << name << ", taken for " << found.model.name;
}

std::string text_of_case(const ::testing::TestParamInfo<StrayPixels::ParamType>& made) {
  const auto [drew, stray, many] = made.param;
  std::string name = drawing[drew];
  for (char& c : name) c = c == '-' ? '_' : c;
  return name + "_" + strays()[stray].name + "_" + std::to_string(counts[many]);
}

INSTANTIATE_TEST_SUITE_P(RightMaps, StrayPixels, ::testing::ValuesIn(stray_cases()), text_of_case);

}  // namespace
}  // namespace fathom::attribution
