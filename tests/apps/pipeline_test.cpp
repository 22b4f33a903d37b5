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
      {"--light", "headlight"},
      {"--light", "1,2,-3", "--material", "0,1,0.5,10"},
      {"--shading", "phong", "--specular-model", "phong"},
      {"--interpolation", "affine"},
      {"--scan", "scan-line"},
      {"--hidden-surface", "painter"},
      {"--antialias", "msaa:4"},
      {"--antialias", "ssaa:2"},
      {"--antialias", "jitter:4"},
      {"--antialias", "area"},
      {"--antialias", "fxaa"},
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

TEST(PipelineCommand, LightsAndMaterialsThatCannotBe) {
  const TestFolder folder;
  const auto refused = [&](const std::string& option, const std::string& value) {
    const Outcome outcome = render(folder, {option, value, "--image", "a.png", "-o", "a.exr"});
    EXPECT_EQ(outcome.status, 2) << option << " " << value;
    EXPECT_THAT(outcome.err, HasSubstr(option));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refused("--light", "0,0,0"), HasSubstr("not all of them 0"));
  refused("--light", "nan,0,1");
  refused("--light", "1,2");
  refused("--light", "below");
  EXPECT_THAT(refused("--material", "0.1,0.7,0.2"), HasSubstr("AMBIENT,DIFFUSE"));
  EXPECT_THAT(refused("--material", "0.1,0.7,-0.2,40"), HasSubstr("none below 0"));
  refused("--material", "0.1,0.7,inf,40");
  refused("--specular-model", "lambert");
  EXPECT_TRUE(folder.names().empty());
}

// As programs write them for triangles without area.
TEST(PipelineCommand, NormalsThatAreNoNumbersAreLeftOut) {
  const TestFolder folder;
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  folder.write("odd.obj", start + "vn nan 0 inf\nf 1//1 2//1 3//2\n");
  folder.write("whole.obj", start + "f 1//1 2//1 3//1\n");
  const auto drawn = [&](const std::string& mesh) {
    const Outcome outcome =
        run_fathom({"render", mesh + ".obj", "--engine", "pipeline", "--shading", "phong", "--size",
                    "32x24", "--image", mesh + ".png", "-o", "a.exr"},
                   {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(drawn("whole"), "");
  EXPECT_EQ(drawn("odd"),
            "fathom: warning: odd.obj: 1 normals, texture coordinates or colours are not finite "
            "numbers; they are left out\n");
  // That corner has the normal of its triangle, which is the same.
  EXPECT_EQ(folder.read("odd.png"), folder.read("whole.png"));
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
  folder.write("empty.png", "");
  EXPECT_THAT(refused("missing.png"), HasSubstr("missing.png: does not exist"));
  EXPECT_THAT(refused("broken.png"), HasSubstr("broken.png: no PNG file"));
  EXPECT_THAT(refused("empty.png"), HasSubstr("empty.png: "));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"broken.png", "empty.png"}));
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

// The ray of a pixel meets the cube twice: its front, and the back of another face.
TEST(PipelineCommand, TraceShowsTheLight) {
  int covered = 0, turned = 0;
  for (int triangle = 0; triangle < 12; ++triangle) {
    const Outcome outcome = run_fathom(
        {"pipeline", "trace", cube, "--triangle", std::to_string(triangle), "--size", "64x48",
         "--pixel", "32,24", "--light", "headlight", "--material", "0,1,0,1", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json trace = Json::parse(outcome.out);
    if (!trace.contains("sample") || !trace["sample"]["covered"]) continue;
    const Json& shading = trace["sample"]["shading"];
    ++covered;
    turned += static_cast<int>(shading["normals_turned"].get<bool>());
    // Lit from the camera, either side has light, and no more than all; no highlight.
    EXPECT_GT(shading["diffuse"], 0.1);
    EXPECT_LT(shading["diffuse"], 1);
    EXPECT_EQ(shading["specular"], 0);
    EXPECT_EQ(shading["colour"][0], shading["diffuse"]);
  }
  EXPECT_EQ(covered, 2);
  EXPECT_EQ(turned, 1);
}

}  // namespace
}  // namespace fathom::test
