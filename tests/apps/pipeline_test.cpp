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
                      "--precision", "binary64", "--subpixel-bits", "16", "--save-camera", "c.json",
                      "-o", "a.exr"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png", "c.json", "s.json"}));
  const Json statistics = Json::parse(folder.read("s.json"));
  EXPECT_EQ(statistics["engine"], "pipeline");
  EXPECT_EQ(statistics["triangles"], 12);
  EXPECT_GT(statistics["fragments"], 0);
  // The exact map for the camera that it says it used has the same surfaces in the same pixels. In
  // binary64, what is left is that corners are moved by up to 2⁻¹⁷ of a pixel, on faces that get
  // deeper by less than 0.3 in a pixel: 8 ulp of depths between 4 and 8.
  const Outcome exact =
      run_fathom({"render", cube, "--camera", "c.json", "--channels", "Z,id", "-o", "b.exr"},
                 {.folder = folder.path()});
  ASSERT_EQ(exact.status, 0) << exact.err;
  const Outcome compared =
      run_fathom({"compare", "b.exr", "a.exr", "--tolerance-ulp", "8", "--json", "d.json"},
                 {.folder = folder.path()});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  const Json channels = Json::parse(folder.read("d.json"))["channels"];
  ASSERT_EQ(channels.size(), 2u);
  for (const Json& channel : channels) {
    EXPECT_GT(channel["both"], 1000) << channel;
    EXPECT_EQ(channel["only_truth"], 0) << channel;
    EXPECT_EQ(channel["only_other"], 0) << channel;
  }
  EXPECT_EQ(channels[1]["different_identifiers"], 0);
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
      {"--antialias", "fxaa:0.125,0.0625"},
      {"--antialias", "taa:4"},
      {"--precision", "binary64"},
      {"--subpixel-bits", "0"},
      {"--viewport", "8,8,32,24"},
      {"--scissor", "8,8,32,24"},
      {"--depth-range", "0.25,0.75"},
      {"--front-face", "cw", "--cull", "front"},
      {"--blend", "--opacity", "0.3"},
      {"--blend", "--blend-depth", "on"},
      {"--blend", "--blend-depth", "read-only", "--draw-order", "back-to-front"},
      {"--draw-order", "front-to-back"},
      {"--draw-order", "random"},
      {"--draw-order", "random:77"},
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

// "facet normal 0 0 0" leaves the normal to the reader; sums at places smooth whatever the file has.
TEST(PipelineCommand, NormalsOfStlFiles) {
  const TestFolder folder;
  const auto drawn = [&](const std::string& name, const std::string& normal, const char* source) {
    const std::string loop = "\nouter loop\nvertex ", end = "\nendloop\nendfacet\n";
    const std::string roof[] = {"0 0 1\nvertex 2 0 0\nvertex 2 2 0",
                                "0 0 1\nvertex 2 2 0\nvertex 0 2 0"};
    std::string text = "solid roof\n";
    for (const std::string& face : roof) text += "facet normal " + normal + loop + face + end;
    folder.write(name + ".stl", text + "endsolid roof\n");
    const Outcome outcome = run_fathom(
        {"render", name + ".stl", "--engine", "pipeline", "--shading", "phong", "--normals", source,
         "--size", "32x24", "--image", name + ".png", "-o", "a.exr"},
        {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return folder.read(name + ".png");
  };
  const std::string zero = drawn("zero", "0 0 0", "file");
  EXPECT_EQ(zero, drawn("vertex", "9 9 9", "vertex"));
  EXPECT_NE(zero, drawn("wrong", "9 9 9", "file"));
  const std::string smooth = drawn("smooth", "9 9 9", "place");
  EXPECT_NE(smooth, zero);
  EXPECT_EQ(smooth, drawn("smooth-zero", "0 0 0", "place"));
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
  refused(3, "name.json: object cone: the scene has no object of this name",
          {"--motion", "name.json"});
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

TEST(PipelineCommand, WritesWhatTheDepthBufferHolds) {
  const TestFolder folder;
  folder.write("s.json", R"({"meshes": [{"file": ")" + cube + R"("}, {"file": ")" + cube +
                             R"(", "draw": {"polygon_offset": [0, -2],
                                 "stencil": {"reference": 7, "pass": "replace"}}}]})");
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", "s.json", "--engine",   "pipeline",
                                       "--size", "64x48",  "--channels", "Z,object"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder.path()});
  };
  ASSERT_EQ(drawn({"--depth-format", "unorm24", "--mapping", "opengl", "--depth-range", "0.5,1",
                   "-o", "a.exr"})
                .status,
            0);
  const Outcome info = run_fathom({"info", "a.exr"}, {.folder = folder.path()});
  for (const char* part : {"Zwindow", "Zdecoded", "stencil", "fathom.depth_range: [0.5, 1]",
                           R"("mapping":"opengl","storage":"unorm24")"})
    EXPECT_THAT(info.out, HasSubstr(part));
  const auto refused = [&](int status, const std::string& why, std::vector<std::string> more) {
    more.insert(more.end(), {"-o", "b.exr"});
    const Outcome outcome = drawn(more);
    EXPECT_EQ(outcome.status, status) << why;
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused(3, "object cube: a polygon offset does not reach", {"--mapping", "log"});
  refused(2, "--depth-range: does not reach", {"--mapping", "w", "--depth-range", "0,0.5"});
  refused(2, "--polygon-offset: does not reach",
          {"--mapping", "linear", "--polygon-offset", "1,1"});
  refused(2, "near and far have the same window depth",
          {"--depth-format", "unorm24", "--depth-range", "0.5,0.5"});
  refused(3, "object cube: its 'draw' is for a depth buffer", {"--hidden-surface", "painter"});
  refused(2, "--blend-depth belongs to --blend", {"--blend-depth", "on"});
  refused(2, "--opacity belongs to --blend", {"--opacity", "0.25"});
  refused(2, "--filter is for a --texture", {"--filter", "nearest"});
  refused(2, "--normals is for --shading gouraud and phong", {"--normals", "place"});
  const std::pair<const char*, const char*> of_light[] = {
      {"--light", "headlight"}, {"--material", "1,0,0,1"}, {"--specular-model", "phong"}};
  for (const auto& [option, value] : of_light) {
    for (const char* unlit : {"none", "points", "wireframe"})
      refused(2, std::string(option) + " is for --shading flat, gouraud and phong",
              {option, value, "--shading", unlit});
  }
  const std::pair<const char*, const char*> of_areas[] = {{"--texture", "checker"},
                                                          {"--scan", "scan-line"}};
  for (const auto& [option, value] : of_areas)
    refused(2, std::string(option) + " is for --shading none, flat, gouraud and phong",
            {option, value, "--shading", "wireframe"});
  refused(2, "--depth-format: the painter's algorithm has no depth buffer",
          {"--hidden-surface", "painter", "--depth-format", "unorm16"});
  refused(2, "--antialias: 'ssaa:2.5' needs a whole number", {"--antialias", "ssaa:2.5"});
  refused(2, "--antialias: 'msaa:' needs a whole number", {"--antialias", "msaa:"});
  refused(2, "the painter compares no depths",
          {"--hidden-surface", "painter", "--polygon-offset", "0,1"});
  refused(2, "the painter has no depth test",
          {"--hidden-surface", "painter", "--blend", "--blend-depth", "on"});
  refused(2, "'4000000000' is not a whole number from -1000000000 to 1000000000",
          {"--viewport", "0,0,4000000000,5"});
  refused(2, "--draw-order", {"--draw-order", "random:x"});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "s.json"}));
}

TEST(PipelineCommand, StretchedViewportIsAWarning) {
  const TestFolder folder;
  EXPECT_THAT(render(folder, {"--viewport", "0,0,64,24", "-o", "a.exr"}).err,
              HasSubstr("stretched"));
}

TEST(PipelineCommand, WindowsOutsideTheImageAreAWarning) {
  const TestFolder folder;
  const std::string warning = "leave no pixel of the image";
  EXPECT_THAT(render(folder, {"--viewport", "100,100,64,48", "-o", "a.exr"}).err,
              HasSubstr(warning));
  EXPECT_THAT(render(folder, {"--scissor", "500,500,2,2", "-o", "a.exr"}).err, HasSubstr(warning));
  EXPECT_THAT(render(folder, {"--scissor", "0,0,2,2", "-o", "a.exr"}).err, Not(HasSubstr(warning)));
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
  EXPECT_THAT(refused("broken.png"), HasSubstr("broken.png: is no PNG file"));
  EXPECT_THAT(refused("empty.png"), HasSubstr("empty.png: is empty, expected a PNG file"));
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
  // What says nothing of a single triangle is no option; what draws none is refused.
  const std::vector<std::string> pictures[] = {{"--scan", "scan-line"},
                                               {"--antialias", "area"},
                                               {"--hidden-surface", "painter"},
                                               {"--shading", "wireframe"}};
  for (const std::vector<std::string>& options : pictures) {
    auto refused = arguments;
    refused.insert(refused.end(), options.begin(), options.end());
    EXPECT_EQ(run_fathom(refused).status, 2) << options[0];
  }
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
    EXPECT_EQ(shading["normals_turned"], trace["facing"]["window"] == "back");
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
