// fathom render --verify.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class Verifying : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }
  Outcome render(const std::string& map, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"render",   "square.obj", "--camera", "camera.json",
                                       "--engine", "fast",       "-o",       map};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder_.path()});
  }

  TestFolder folder_;
};

TEST_F(Verifying, SaysHowManyPixelsAgree) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"1", "1"}, {"20", "20"}, {"48", "48"}, {"4000000", "48"}, {"all", "48"}};
  for (const auto& [asked, verified] : cases) {
    const Outcome outcome =
        render("a.exr", {"--verify", asked, "--channels", "Z", "--stats", "stats.json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "fathom: a.exr: " + verified +
                               " of 48 pixels verified by exact arithmetic, all agree\n");
    EXPECT_EQ(outcome.out, "");
    const Json stats = Json::parse(folder_.read("stats.json"));
    EXPECT_EQ(stats.at("verified"), std::stoi(verified));
    EXPECT_EQ(stats.at("nearly_unsettled"), 0);
    EXPECT_EQ(stats.at("differing"), 0);
    EXPECT_GE(stats.at("seconds").at("verify"), 0.0);
  }
}

TEST_F(Verifying, EveryFormatEngineAndChannel) {
  EXPECT_EQ(
      render("a.exr", {"--verify", "all", "--channels", "Z,Zlow,distance,id,face,object,N,P,bary"})
          .status,
      0);
  for (const char* map : {"a.pfm", "a.png", "a.npy"}) {
    EXPECT_THAT(render(map, {"--verify", "all"}).err, HasSubstr("48 of 48")) << map;
  }
  EXPECT_THAT(render("b.npy", {"--verify", "all", "--dtype", "float64"}).err, HasSubstr("agree"));
  EXPECT_THAT(render("b.exr", {"--verify", "all", "--cull", "front"}).err, HasSubstr("agree"));
}

TEST_F(Verifying, EveryMapOfAPath) {
  folder_.write("path.json", "[" + square_camera + ", " + camera_with("near", "2") + "]");
  const Outcome outcome =
      run_fathom({"render", "square.obj", "--camera", "path.json", "--engine", "fast", "--verify",
                  "9", "--stats", "stats.json", "-o", "{index}.pfm"},
                 {.folder = folder_.path()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("fathom: 0.pfm: 9 of 48"));
  // The surface lies on the second near plane: 16 samples ask whether they are beyond it.
  EXPECT_THAT(outcome.err, HasSubstr("fathom: 1.pfm: 21 of 48"));
  EXPECT_THAT(outcome.err, HasSubstr("(16 of them near the limit of an error bound)"));
  const Json second = Json::parse(folder_.read("stats.json")).at(1);
  EXPECT_EQ(second.at("verified"), 21);
  EXPECT_EQ(second.at("nearly_unsettled"), 16);
}

TEST_F(Verifying, QuietAndUnasked) {
  EXPECT_EQ(render("a.exr", {"--verify", "all", "--quiet"}).err, "");
  const Outcome plain = render("a.exr", {"--stats", "-"});
  EXPECT_EQ(plain.err, "");
  EXPECT_FALSE(Json::parse(plain.out).contains("verified"));
}

TEST_F(Verifying, WrongNumbers) {
  for (const char* number : {"0", "-1", "1.5", "some", "ALL"}) {
    const Outcome outcome = render("a.exr", {"--verify", number});
    EXPECT_EQ(outcome.status, 2) << number;
    EXPECT_THAT(outcome.err, HasSubstr("--verify")) << number;
  }
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"camera.json", "square.obj"}));
}

}  // namespace
}  // namespace fathom::test
