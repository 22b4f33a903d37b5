#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

/// `fathom validate --rays` with Embree as it is installed (FATHOM_PEERS).
namespace fathom::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

TEST(ValidateRays, FindsWhatEmbreeLosesAtCorners) {
  const TestFolder folder;
  const Outcome outcome = run_fathom({"validate", "--rays", "embree,embree-robust,cgal", "--scene",
                                      "sphere", "--count", "1000", "-o", "report"},
                                     {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const Json results = Json::parse(folder.read("report/rays.json"))["results"];
  ASSERT_EQ(results.size(), 3U * 4);
  for (const Json& result : results) {
    const Json& verdicts = result["verdicts"];
    std::uint64_t sum = 0;
    for (const Json& count : verdicts) sum += count.get<std::uint64_t>();
    EXPECT_EQ(sum, 1000U);
    EXPECT_GE(verdicts["right"], 400) << result;
    if (result["engine"] == "cgal") {
      EXPECT_EQ(verdicts["right"].get<int>() + verdicts["tie"].get<int>(), 1000) << result;
      EXPECT_EQ(result["wrong"], Json::array());
    } else if (result["rays"] == "corners") {
      EXPECT_GT(verdicts["lost"].get<int>() + verdicts["behind"].get<int>() +
                    verdicts["beside"].get<int>(),
                0)
          << result;
      EXPECT_FALSE(result["wrong"].empty());
    }
  }
}

TEST(ValidateRays, IsSatisfiedWithCgal) {
  const Outcome outcome =
      run_fathom({"validate", "--rays", "cgal", "--scene", "sphere", "--count", "50"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("corners"));
}

TEST(ValidateRays, RefusesOtherOptions) {
  const auto refusal = [](const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"validate"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_fathom(all);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_THAT(refusal({"--rays", "optix"}), HasSubstr("there is no ray engine 'optix'"));
  EXPECT_THAT(refusal({"--rays", "cgal", "--model", "auto"}), HasSubstr("--model"));
  EXPECT_THAT(refusal({"--rays", "cgal", "--against", "vtk"}), HasSubstr("is expected"));
  EXPECT_THAT(refusal({"--against", "vtk", "--count", "5"}), HasSubstr("--count goes with --rays"));
}

}  // namespace
}  // namespace fathom::test
