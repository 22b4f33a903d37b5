// fathom render --engine pipeline, and fathom pipeline trace.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run_program.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

const std::string cube = source_dir() / "data/meshes/cube.obj";

Outcome render(const TestFolder& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{"render", cube, "--engine", "pipeline", "--size", "64x48"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_fathom(arguments, {.folder = folder.path()});
}

TEST(PipelineCommand, WritesMapPictureCameraAndStatistics) {
  const TestFolder folder;
  const Outcome outcome =
      render(folder, {"--channels", "Z,id,face,object", "--image", "a.png", "--stats", "s.json",
                      "--save-camera", "c.json", "-o", "a.exr"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png", "c.json", "s.json"}));
  const Json statistics = Json::parse(folder.read("s.json"));
  EXPECT_EQ(statistics["engine"], "pipeline");
  EXPECT_EQ(statistics["triangles"], 12);
  EXPECT_GT(statistics["fragments"], 0);
  // The exact map for the camera that it says it used has surfaces in the same pixels.
  const Outcome exact =
      run_fathom({"render", cube, "--camera", "c.json", "--channels", "Z,id", "-o", "b.exr"},
                 {.folder = folder.path()});
  ASSERT_EQ(exact.status, 0) << exact.err;
  const Outcome compared =
      run_fathom({"compare", "b.exr", "a.exr", "--json", "d.json"}, {.folder = folder.path()});
  EXPECT_LE(compared.status, 1) << compared.err;
}

TEST(PipelineCommand, EveryChoiceDraws) {
  const TestFolder folder;
  const std::vector<std::vector<std::string>> choices{
      {"--shading", "none"},
      {"--shading", "wireframe", "--line", "diamond-exit"},
      {"--shading", "points"},
      {"--antialias", "msaa:rotated-grid"},
      {"--shading", "gouraud"},
      {"--shading", "phong"},
      {"--interpolation", "affine"},
      {"--scan", "scan-line"},
      {"--hidden-surface", "painter"},
      {"--antialias", "msaa:4"},
      {"--antialias", "ssaa:2"},
      {"--antialias", "jitter:4"},
      {"--antialias", "area"},
      {"--antialias", "fxaa"},
      {"--antialias", "fxaa:0.125,0.0625"},
      {"--antialias", "taa:4"},
      {"--precision", "binary64"},
      {"--subpixel-bits", "0"},
      {"--viewport", "8,8,32,24"},
      {"--scissor", "8,8,32,24"},
      {"--depth-range", "0.25,0.75"},
      {"--front-face", "cw", "--cull", "front"},
      {"--blend", "--opacity", "0.3"},
      {"--polygon-offset", "1,1"},
      {"--background", "0.1,0.2,0.3"},
      {"--depth-format", "unorm24", "--mapping", "reversed"}};
  for (const auto& choice : choices) {
    std::vector<std::string> arguments{"--image", "a.png", "-o", "a.exr"};
    arguments.insert(arguments.end(), choice.begin(), choice.end());
    EXPECT_EQ(render(folder, arguments).status, 0) << choice[0] << " " << choice.back();
  }
}

/// Half-way between two keyframes the exact engine and the pipeline see the cube in the same place.
TEST(PipelineCommand, MotionPlacesObjectsForEveryEngine) {
  const TestFolder folder;
  folder.write("m.json", R"({"objects": [{"name": "cube", "keyframes": [
    {"time": 0, "transform": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]},
    {"time": 2, "transform": [[1,0,0,1],[0,1,0,0],[0,0,1,0]]}]}]})");
  ASSERT_EQ(render(folder, {"--motion", "m.json", "--time", "1", "--channels", "Z,id",
                            "--save-camera", "c.json", "-o", "a.exr"})
                .status,
            0);
  const std::vector<std::string> exact{"render", cube, "--camera", "c.json", "--channels", "Z,id"};
  const auto compared = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = exact;
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_fathom(arguments, {.folder = folder.path()}).status, 0);
    const Outcome outcome =
        run_fathom({"compare", "b.exr", "a.exr", "--json", "d.json"}, {.folder = folder.path()});
    EXPECT_LE(outcome.status, 1) << outcome.err;
    return outcome.out;
  };
  const std::string moved = compared({"--motion", "m.json", "--time", "1", "-o", "b.exr"});
  const std::string at_rest = compared({"--motion", "m.json", "-o", "b.exr"});
  EXPECT_THAT(moved, HasSubstr("in the first only 0, in the other only 0"));
  EXPECT_THAT(at_rest, testing::Not(HasSubstr("in the first only 0, in the other only 0")));
  for (const char* method : {"temporal:4", "temporal-area:2", "taa:4"}) {
    EXPECT_EQ(render(folder, {"--motion", "m.json", "--shutter", "0,1", "--antialias", method,
                              "--image", "a.png", "-o", "c.exr"})
                  .status,
              0)
        << method;
  }
}

TEST(PipelineCommand, MotionThatMeansNothingIsRefusedInOneLine) {
  const TestFolder folder;
  const std::string still = R"([[1,0,0,0],[0,1,0,0],[0,0,1,0]])";
  const auto motion = [&](const std::string& name, const std::string& second) {
    return R"({"objects": [{"name": ")" + name + R"(", "keyframes": [{"time": 1, "transform": )" +
           still + R"(}, {"time": )" + second + R"(, "transform": )" + still + "}]}]}";
  };
  folder.write("m.json", motion("cube", "2"));
  folder.write("order.json", motion("cube", "1"));
  folder.write("name.json", motion("cone", "2"));
  const auto refused = [&](int status, const std::string& why, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", "a.exr"});
    const Outcome outcome = render(folder, arguments);
    EXPECT_EQ(outcome.status, status) << why;
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused(3, "the times of keyframes have to increase", {"--motion", "order.json"});
  refused(3, "the scene has no object of this name", {"--motion", "name.json"});
  refused(3, "none.json", {"--motion", "none.json"});
  refused(2, "--time needs --motion", {"--time", "1"});
  refused(2, "need --motion and --shutter", {"--antialias", "temporal:4"});
  refused(2, "need --motion and --shutter", {"--antialias", "temporal:4", "--motion", "m.json"});
  refused(2, "--shutter needs --motion", {"--antialias", "taa:4", "--shutter", "0,1"});
  refused(2, "--shutter is for", {"--motion", "m.json", "--shutter", "0,1"});
  refused(2, "--shutter: expected OPEN,CLOSE",
          {"--motion", "m.json", "--antialias", "taa:4", "--shutter", "1,1"});
  refused(2, "numbers from 0 to 1", {"--antialias", "fxaa:2"});
  refused(2, "fxaa:THRESHOLD,LEAST,SUBPIXEL", {"--antialias", "fxaa:0.1,0.1,0.1,0.1"});
  refused(2, "area sees the nearest surface", {"--antialias", "area", "--blend"});
}

TEST(PipelineCommand, StretchedViewportIsAWarning) {
  const TestFolder folder;
  EXPECT_THAT(render(folder, {"--viewport", "0,0,64,24", "-o", "a.exr"}).err,
              HasSubstr("stretched"));
}

TEST(PipelineCommand, TexturesThatCannotBeUsed) {
  const TestFolder folder;
  const auto refused = [&](const std::string& texture) {
    const Outcome outcome =
        render(folder, {"--texture", texture, "--image", "a.png", "-o", "a.exr"});
    EXPECT_EQ(outcome.status, 3);
    return outcome.err;
  };
  folder.write("broken.png", "this is no picture");
  EXPECT_THAT(refused("missing.png"), HasSubstr("missing.png: does not exist"));
  EXPECT_THAT(refused("broken.png"), HasSubstr("broken.png: no PNG file"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"broken.png"});
}

TEST(PipelineCommand, TextureIsNotOverwritten) {
  const TestFolder folder;
  const std::vector<std::string> picture{"--image", "own.png", "-o", "a.exr"};
  ASSERT_EQ(render(folder, picture).status, 0);
  const std::string before = folder.read("own.png");
  const Outcome outcome =
      render(folder, {"--texture", "own.png", "--image", "own.png", "-o", "b.exr"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("own.png: is an input of this command"));
  EXPECT_EQ(folder.read("own.png"), before);
}

TEST(PipelineCommand, APathOfCamerasNeedsAPatternForEachFile) {
  const TestFolder folder;
  ASSERT_EQ(run_fathom({"camera", "orbit", cube, "--views", "2", "-o", "path.json"},
                       {.folder = folder.path()})
                .status,
            0);
  const auto drawn = [&](const std::string& picture, const std::string& map) {
    return run_fathom({"render", cube, "--engine", "pipeline", "--camera", "path.json", "--image",
                       picture, "-o", map},
                      {.folder = folder.path()});
  };
  EXPECT_THAT(drawn("{index}.png", "a.exr").err, HasSubstr("-o needs a pattern"));
  EXPECT_THAT(drawn("a.png", "{index}.exr").err, HasSubstr("--image needs a pattern"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"path.json"});
}

TEST(PipelineCommand, TraceInTextAndJson) {
  const std::vector<std::string> arguments{"pipeline", "trace", cube,      "--triangle", "3",
                                           "--size",   "64x48", "--pixel", "32,24"};
  const Outcome text = run_fathom(arguments);
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("by the determinant in the window"));
  auto with_json = arguments;
  with_json.emplace_back("--json");
  const Outcome outcome = run_fathom(with_json);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json trace = Json::parse(outcome.out);
  EXPECT_EQ(trace["vertex_transform"].size(), 3u);
  EXPECT_EQ(trace["clipping"].size(), 3u);
  EXPECT_EQ(trace["facing"]["world"], trace["facing"]["window"]);
  EXPECT_EQ(trace["facing"]["ndc"], trace["facing"]["window"]);
  // The stages join: NDC is clip over w.
  const Json& corner = trace["clipping"][0];
  EXPECT_EQ(corner["ndc"][0].get<float>(),
            corner["clip"][0].get<float>() / corner["clip"][3].get<float>());
  EXPECT_EQ(run_fathom({"pipeline", "trace", cube, "--triangle", "12"}).status, 2);
  EXPECT_EQ(run_fathom({"pipeline"}).status, 2);
}

}  // namespace
}  // namespace fathom::test
