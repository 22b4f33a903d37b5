// fathom render --engine pipeline, and fathom pipeline trace.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
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

// "facet normal 0 0 0" leaves the normal to the reader; sums at places smooth whatever the file
// has.
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
  refused(3, "object cube: its 'draw' is for a depth buffer; the painter's algorithm supports",
          {"--hidden-surface", "painter"});
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
  const std::vector<std::string> pictures[] = {
      {"--scan", "scan-line"}, {"--antialias", "area"}, {"--shading", "wireframe"}};
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

Json traced(const TestFolder& folder, std::vector<std::string> more) {
  more.insert(more.begin(), {"pipeline", "trace"});
  more.emplace_back("--json");
  const Outcome outcome = run_fathom(more, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

TEST(PipelineCommand, TraceShowsTheOutputMerger) {
  const TestFolder folder;
  const std::vector<std::string> view{cube,    "--size",       "64x48", "--pixel",
                                      "32,24", "--background", "1,0,0"};
  const Json trace = traced(folder, view);
  const Json& steps = trace["output_merger"];
  ASSERT_EQ(steps.size(), 2u);  // the front and the back of the cube
  EXPECT_EQ(steps[0]["before"]["primitive"], nullptr);
  EXPECT_EQ(steps[0]["before"]["colour"], Json::parse("[1.0, 0.0, 0.0]"));
  EXPECT_EQ(steps[0]["tests"]["outcome"], "passed");
  EXPECT_EQ(steps[1]["before"], steps[0]["after"]);
  const bool nearer =
      steps[1]["fragment"]["stored"]["value"] < steps[0]["fragment"]["stored"]["value"];
  EXPECT_EQ(steps[1]["tests"]["outcome"], nearer ? "passed" : "depth test failed");
  auto blended = view;
  blended.insert(blended.end(), {"--blend", "--opacity", "0.25"});
  const Json glass = traced(folder, blended)["output_merger"];
  for (const Json& step : glass) {
    EXPECT_EQ(step["blend"]["alpha"], 0.25);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_FLOAT_EQ(step["after"]["colour"][k].get<float>(),
                      static_cast<float>(0.25 * step["fragment"]["colour"][k].get<double>() +
                                         0.75 * step["before"]["colour"][k].get<double>()));
  }
  const Outcome text =
      run_fathom({"pipeline", "trace", cube, "--size", "64x48", "--pixel", "32,24"});
  EXPECT_THAT(text.out, HasSubstr("in the pixel  background, depth 1 ("));
  EXPECT_THAT(text.out, HasSubstr("depth test    nearer: passed"));
}

TEST(PipelineCommand, TraceFollowsLinesAndPointsAndListsFragments) {
  const TestFolder folder;
  folder.write("s.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 3 1\nf 1 2 3\nl 1 4\np 2\n");
  const std::vector<std::string> view{"s.obj", "--size", "32x24"};
  const auto primitive = [&](const char* number) {
    auto arguments = view;
    arguments.insert(arguments.end(), {"--primitive", number, "--fragments"});
    return traced(folder, arguments);
  };
  EXPECT_EQ(primitive("0")["primitive"], "triangle");
  const Json line = primitive("1"), point = primitive("2");
  EXPECT_EQ(line["primitive"], "line");
  EXPECT_EQ(line["clipping"].size(), 2u);
  EXPECT_GT(line["fragment_list"].size(), 3u);
  EXPECT_EQ(line["fragment_list"].size(), line["fragments"]);
  EXPECT_EQ(point["primitive"], "point");
  EXPECT_EQ(point["fragment_list"].size(), 1u);
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"pipeline", "trace", "s.obj"});
    const Outcome outcome = run_fathom(more, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused({"--primitive", "3"}), HasSubstr("1 triangles, then 2 lines and points"));
  EXPECT_THAT(refused({"--triangle", "1"}), HasSubstr("there is no triangle 1; the scene has 1"));
  EXPECT_THAT(refused({"--triangle", "0", "--primitive", "0"}), HasSubstr("exclude each other"));
}

TEST(PipelineCommand, TraceWarnsOfAStretchedViewport) {
  const auto warned = [](const char* viewport) {
    const Outcome outcome =
        run_fathom({"pipeline", "trace", cube, "--size", "64x48", "--viewport", viewport});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(warned("0,0,64,24"), HasSubstr("the picture is stretched"));
  EXPECT_EQ(warned("0,0,32,24"), "");
}

Json run_stage(const std::string& stage, const Json& record, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"pipeline", "run", stage});
  const Outcome outcome = run_fathom(more, {.input = record.dump() + "\n"});
  EXPECT_EQ(outcome.status, 0) << outcome.err << record;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

// Every stage by itself, one after the other, is what the trace shows.
TEST(PipelineCommand, TheStagesOneByOneAreTheTrace) {
  const TestFolder folder;
  folder.write("s.obj", "v 0 0 0\nv 3 0 1\nv 0 2 -9\nf 1 2 3\n");
  folder.write(
      "c.json",
      R"({"width": 12, "height": 9, "fx": 9, "fy": 9, "cx": 6, "cy": 4.5, "pixel_centre": 0.5,
    "world_to_camera": [[1,0,0,-1],[0,-1,0,1],[0,0,-1,2]], "near": 0.5, "far": 20})");
  for (const std::string precision : {"binary32", "binary64"}) {
    const Json trace =
        traced(folder, {"s.obj", "--camera", "c.json", "--precision", precision, "--shading",
                        "none", "--fragments", "--pixel", "6,4", "--mapping", "opengl"});
    const std::vector<std::string> with{"--precision", precision};
    Json record{{"vertices", {{0, 0, 0}, {3, 0, 1}, {0, 2, -9}}},
                {"camera", Json::parse(folder.read("c.json"))},
                {"mapping", "opengl"},
                {"indices", {0, 1, 2}}};
    const Json assembled = run_stage("primitive-assembly", record, with);
    ASSERT_EQ(assembled["primitives"].size(), 1u);
    EXPECT_EQ(assembled["primitives"][0]["vertices"], record["vertices"]);
    record = run_stage("vertex-transform", record, with);
    for (std::size_t k = 0; k < 3; ++k)
      for (const char* space : {"world", "eye", "clip"})
        EXPECT_EQ(record[space][k], trace["vertex_transform"][k][space]);
    record = run_stage("clipping", record, with);
    record = run_stage("perspective-division", record, with);
    record = run_stage("back-face-culling", record, with);
    EXPECT_EQ(record["facing"]["ndc"], trace["facing"]["ndc"]);
    EXPECT_EQ(record["culled"], trace["culled"]);
    record = run_stage("viewport", record, with);
    EXPECT_EQ(record["stretched"], false);
    ASSERT_EQ(record["clip"].size(), trace["clipping"].size());
    for (std::size_t k = 0; k < record["clip"].size(); ++k)
      for (const char* space : {"clip", "ndc", "window"})
        EXPECT_EQ(record[space][k], trace["clipping"][k][space]);
    record = run_stage("scan-conversion", record, with);
    ASSERT_EQ(record["fragments"].size(), trace["fragments"]);
    ASSERT_GT(record["fragments"].size(), 5u);
    for (std::size_t i = 0; i < record["fragments"].size(); ++i)
      for (const char* key : {"pixel", "window_z", "depth", "colour"})
        EXPECT_EQ(record["fragments"][i][key], trace["fragment_list"][i][key]) << key << i;
    record = run_stage("output-merger", record, with);
    const Json& merged = record["merged"];
    const auto at_pixel = std::find_if(merged.begin(), merged.end(), [](const Json& step) {
      return step["pixel"] == Json::parse("[6, 4]");
    });
    ASSERT_NE(at_pixel, merged.end());
    EXPECT_EQ(*at_pixel, trace["output_merger"][0]);
    EXPECT_EQ(record["buffer"].size(), record["fragments"].size());
  }
}

TEST(PipelineCommand, StagesByHand) {
  // 002: the far side's w is negative: of P, in front, and Q, behind the eye, P's part is left.
  const Json clipped = run_stage(
      "clipping",
      Json::parse(R"({"clip": [[0,0,1,1],[0,0,-3,-1]], "mapping": "opengl", "name": "PQ"})"),
      {"--precision", "binary64"});
  EXPECT_EQ(clipped["name"], "PQ");
  EXPECT_EQ(clipped["clip"].size(), 2u);
  for (const Json& p : clipped["clip"]) EXPECT_LE(std::abs(p[2].get<double>()), p[3].get<double>());
  EXPECT_EQ(run_stage("perspective-division", Json::parse(R"({"clip": [[3,1,2,8]]})"))["ndc"],
            Json::parse("[[0.375, 0.125, 0.25]]"));
  // 003: minX + w/2, the window's origin on the lower left; the rows of images count from above.
  const Json window =
      run_stage("viewport", Json::parse(R"({"ndc": [[0,0,0],[1,1,1]], "width": 40, "height": 30,
    "viewport": [4, 6, 20, 10], "depth_range": [0.25, 0.75], "mapping": "opengl"})"));
  EXPECT_EQ(window["window"], Json::parse("[[14.0, 19.0, 0.5],[24.0, 14.0, 0.75]]"));
  EXPECT_TRUE(window["stretched"]);
  const Json back = run_stage("back-face-culling",
                              Json::parse(R"({"ndc": [[0,0,0],[0,1,0],[1,0,0]], "cull": "back"})"));
  EXPECT_EQ(back["facing"]["ndc"], "back");
  EXPECT_EQ(back["culled"], true);
  // What is nearer wins, in either order.
  const std::string fragments =
      R"("fragments": [{"pixel": [0,0], "window_z": 0.5, "colour": [1,0,0]},
    {"pixel": [0,0], "window_z": 0.75, "colour": [0,1,0]},
    {"pixel": [1,0], "window_z": 0.25, "colour": [0,0,1]}])";
  const Json merged =
      run_stage("output-merger", Json::parse("{\"width\": 2, \"height\": 1, " + fragments + "}"));
  EXPECT_EQ(merged["merged"][1]["tests"]["outcome"], "depth test failed");
  EXPECT_EQ(merged["buffer"][0]["colour"], Json::parse("[1.0, 0.0, 0.0]"));
  Json again = merged;
  again["fragments"] = Json::parse(R"([{"pixel": [0,0], "window_z": 0.25, "colour": [0,0,1]}])");
  EXPECT_EQ(run_stage("output-merger", again)["buffer"][0]["colour"],
            Json::parse("[0.0, 0.0, 1.0]"));
  // A line and a point are scan-converted as such.
  EXPECT_EQ(
      run_stage(
          "scan-conversion",
          Json::parse(
              R"({"window": [[0.5,0.5,0],[3.5,1.5,0]], "width": 8, "height": 8})"))["fragments"]
          .size(),
      4u);
  EXPECT_EQ(
      run_stage(
          "scan-conversion",
          Json::parse(
              R"({"window": [[2.5,1.5,0]], "width": 8, "height": 8})"))["fragments"][0]["pixel"],
      Json::parse("[2, 1]"));
}

TEST(PipelineCommand, StagesRefuseInOneLine) {
  const auto refused = [](const std::string& stage, const std::string& record,
                          const std::string& said) {
    const Outcome outcome = run_fathom({"pipeline", "run", stage}, {.input = record + "\n"});
    EXPECT_EQ(outcome.status, 3) << record;
    EXPECT_THAT(Json::parse(outcome.out).value("error", ""), HasSubstr(said)) << record;
  };
  refused("clipping", R"({"clop": []})", "\"clop\" is not a key of a stage");
  refused("clipping", "{}", "\"clip\" is missing");
  refused("perspective-division", R"({"clip": [[1,1,1,0]]})", "w = 0");
  refused("viewport", R"({"ndc": [[0,0,0]]})", "\"width\" is missing");
  refused("viewport", R"({"ndc": [[0,0,0]], "width": 1.5, "height": 2})",
          "expected a whole number");
  refused("vertex-transform", R"({"vertices": [[0,0,0]]})", "\"camera\" is missing");
  refused("vertex-transform", R"({"vertices": [[0,0,0]], "camera": {"width": 4}})", "camera");
  refused("clipping", R"({"clip": [[0,0,0,1]], "mapping": "isometric"})",
          "\"mapping\": there is no mapping 'isometric'");
  refused("primitive-assembly", R"({"vertices": [[0,0,0]], "indices": [1]})",
          "not the number of one of 1 vertex");
  refused("clipping", R"({"clip": [[0,0,0,1]], "colours": []})", "0 values for 1 corner");
  refused("output-merger",
          R"({"width": 1, "height": 1, "fragments": [{"pixel": [1,0], "colour": [0,0,0]}]})",
          "no pixel of the image");
  EXPECT_EQ(run_fathom({"pipeline", "run", "tessellation"}).status, 2);
}

}  // namespace
}  // namespace fathom::test
