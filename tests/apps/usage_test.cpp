// Wrong usage is exit status 2 and one line; help and version are there for every command.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Usage {
  std::string name;
  std::vector<std::string> arguments;
  std::string said;
};

void PrintTo(const Usage& usage, std::ostream* stream) {
  *stream << usage.name;
}

std::vector<Usage> wrong_usages() {
  const auto render = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "square.obj", "-o", "map.exr"});
    return more;
  };
  return {
      {"NoCommand",
       {"camera"},
       "needs a command: look-at, orbit, directions, shutter or import; see"},
      {"UnknownCommand", {"rendre", "square.obj"}, "did you mean 'render'"},
      {"UnknownOption", render({"--frobnicate"}), "--frobnicate"},
      {"NoOutput", {"render", "square.obj"}, "--output"},
      {"NoScene", {"render", "-o", "map.exr"}, "SCENE"},
      {"NoSuffix", {"render", "square.obj", "-o", "map"}, ".exr"},
      {"UnknownSuffix", {"render", "square.obj", "-o", "map.bmp"}, ".exr"},
      {"ShadingOfAnotherEngine", render({"--shading", "phong"}),
       "--shading is for --engine pipeline"},
      {"NormalsOfNothing", render({"--normals", "vertex", "--channels", "Z,N"}),
       "--normals is for channel Ns and for --engine pipeline"},
      {"NormalsStreamed", render({"--channels", "Z,Ns", "--stream"}), "leave out Ns"},
      {"PipelineVerify", render({"--engine", "pipeline", "--verify", "5"}),
       "--verify is for exact engines"},
      {"PipelineMsaa", render({"--engine", "pipeline", "--antialias", "msaa:3"}),
       "msaa:3 does not exist; there are 1, 2, 4, 8 and 16"},
      {"PipelineViewport", render({"--engine", "pipeline", "--viewport", "0,0,0,5"}),
       "--viewport: expected a size of at least 1x1"},
      {"PipelineChannel", render({"--engine", "pipeline", "--channels", "N"}),
       "the pipeline gives Z, id, face, object, material, group, part and label"},
      {"MattesUnknown", render({"--cryptomatte-by", "label"}), "object, material, group and part"},
      {"MattesTwice", render({"--cryptomatte-by", "part,part"}), "twice"},
      {"MattesForPng",
       {"render", "square.obj", "-o", "map.png", "--cryptomatte-by", "part"},
       "--cryptomatte is for .exr"},
      {"PipelineImage", render({"--engine", "pipeline", "--image", "a.jpg"}), ".png"},
      {"EngineUnknown", render({"--engine", "warp"}), "fast, reference and pipeline"},
      {"AreaForPng",
       {"render", "square.obj", "-o", "map.png", "--channels", "A"},
       "a PNG holds depths, normals or numbers, not A"},
      {"VerifyNothing", render({"--verify", ""}), "--verify: the value is empty"},
      {"ChannelsNone", render({"--channels", ""}), "--channels: the value is empty"},
      {"ChannelUnknown", render({"--channels", "dpth"}), "there are Z"},
      {"ChannelTwice", render({"--channels", "Z,Z"}), "twice"},
      {"DeepForPfm", {"render", "square.obj", "-o", "map.pfm", "--deep"}, "--deep is for .exr"},
      {"DeepWithChannels", render({"--deep", "--channels", "Z"}),
       "--deep always has the channels A, Z"},
      {"DeepByPiz", render({"--deep", "--compression", "piz"}), "zips, rle or none"},
      {"DeepStreamed", render({"--deep", "--stream"}), "--stream"},
      {"CryptomatteForPng",
       {"render", "square.obj", "-o", "map.png", "--cryptomatte"},
       "--cryptomatte is for .exr"},
      {"CryptomatteStreamed", render({"--cryptomatte", "--stream"}), "--stream"},
      {"CullUnknown", render({"--cull", "some"}), "back, front and none"},
      {"LossyCompression", render({"--compression", "pxr24"}), "is lossy"},
      {"UnknownCompression", render({"--compression", "lzma"}), "zip"},
      {"PngScaleForExr", render({"--png-scale", "10"}), "--png-scale is for .png"},
      {"DtypeForExr", render({"--dtype", "float64"}), "--dtype is for .npy"},
      {"CompressionForPng",
       {"render", "square.obj", "-o", "map.png", "--compression", "zip"},
       "--compression is for .exr"},
      {"NegativePngScale",
       {"render", "square.obj", "-o", "map.png", "--png-scale", "-1"},
       "positive"},
      {"UnknownDtype", {"render", "square.obj", "-o", "map.npy", "--dtype", "int8"}, "float64"},
      {"TwoChannelsInPfm",
       {"render", "square.obj", "-o", "map.pfm", "--channels", "Z,id"},
       "one channel"},
      {"NormalsInPfm", {"render", "square.obj", "-o", "map.pfm", "--channels", "N"}, "one channel"},
      {"SizeNoNumber", render({"--size", "big"}), "--size"},
      {"SizeZero", render({"--size", "0x10"}), "--size"},
      {"FovStraight", render({"--fov", "180"}), "--fov"},
      {"FovNan", render({"--fov", "nan"}), "--fov"},
      {"ViewOneNumber", render({"--view", "30"}), "--view"},
      {"ViewBeyondPole", render({"--view", "0,91"}), "90"},
      {"UpUnknown", render({"--up", "w"}), "--up: 'w' is not x, y, z, -x, -y, -z or a direction"},
      {"UpZero", render({"--up", "0,0,0"}), "the up direction is zero"},
      {"FocalWithFov", render({"--focal", "500", "--fov", "40"}), "--fov"},
      {"VerifyText", render({"--verify", "al"}), "did you mean 'all'?"},
      {"FarText", render({"--far", "info"}), "'info' is not inf or a number; did you mean 'inf'?"},
      {"ThreadsNegative", render({"--threads", "-1"}), "--threads"},
      {"ThreadsText", render({"--threads", "all"}), "--threads"},
      {"CameraWithView", render({"--camera", "camera.json", "--view", "0,0"}), "--camera"},
      {"StandardInputTwice", {"render", "-", "-", "--mesh-format", "obj", "-o", "map.exr"}, "once"},
      {"MeshFormatUnknown", render({"--mesh-format", "fbx"}), "--mesh-format"},
      {"PathWithoutPattern", render({"--camera", "path.json"}), "{index"},
      {"PatternWrong",
       {"render", "square.obj", "--camera", "path.json", "-o", "{index:x!}.exr"},
       "there is no field"},
      {"ProbeWithoutPixel", {"probe", "square.obj"}, "--pixel"},
      {"ProbePixelOutside",
       {"probe", "square.obj", "--camera", "camera.json", "--pixel", "8,0"},
       "8x6"},
      {"ProbePixelText", {"probe", "square.obj", "--pixel", "middle"}, "--pixel"},
      {"ProbePath", {"probe", "square.obj", "--camera", "path.json", "--pixel", "0,0"}, "path"},
      {"RangeOfTwoWords",
       {"preview", "map.exr", "-o", "p.png", "--range", "0", "5"},
       "unexpected argument '5'; --range takes LOW,HIGH, with a comma"},
      {"ColourMapUnknown", {"preview", "map.exr", "-o", "p.png", "--colormap", "jet"}, "viridis"},
      {"ToleranceNegative",
       {"compare", "a.exr", "b.exr", "--tolerance-ulp", "-1"},
       "--tolerance-ulp"},
      {"ConvertToUnknown", {"convert", "older.exr", "-o", "map.bmp"}, ".exr"},
      {"CameraWithoutKind", {"camera"}, "--help"},
      {"LookAtItself", {"camera", "look-at", "--eye", "1,2,3", "--target", "1,2,3"}, ""},
      {"OrbitNothing", {"camera", "orbit", "--views", "3"}, "SCENE"},
      {"OrbitNoViews", {"camera", "orbit", "square.obj", "--views", "0"}, "--views"},
      {"GltfWithoutSize", {"camera", "import", "gltf", "model.gltf"}, "--size"},
  };
}

class WrongUsage : public ::testing::TestWithParam<Usage> {};

TEST_P(WrongUsage, IsStatusTwoInOneLine) {
  const TestFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("camera.json", square_camera);
  folder.write("path.json", "[" + square_camera + "," + square_camera + "]");
  folder.write("map.exr", "older");
  const auto before = folder.names();
  const Outcome outcome = run_fathom(GetParam().arguments, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(StartsWith("fathom: error: "), HasSubstr(GetParam().said)));
  EXPECT_EQ(folder.read("map.exr"), "older");
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(All, WrongUsage, ::testing::ValuesIn(wrong_usages()),
                         [](const auto& test) { return test.param.name; });

TEST(Help, OfEveryCommandShowsAnExample) {
  const std::vector<std::vector<std::string>> commands{{},
                                                       {"render"},
                                                       {"probe"},
                                                       {"info"},
                                                       {"preview"},
                                                       {"compare"},
                                                       {"convert"},
                                                       {"camera"},
                                                       {"camera", "look-at"},
                                                       {"camera", "orbit"},
                                                       {"camera", "import"},
                                                       {"camera", "import", "colmap"},
                                                       {"camera", "import", "nerf"},
                                                       {"camera", "import", "bop"},
                                                       {"camera", "import", "opengl"}};
  for (std::vector<std::string> command : commands) {
    std::string name = "fathom";
    for (const std::string& word : command) name += " " + word;
    command.emplace_back("--help");
    const Outcome help = run_fathom(command);
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_THAT(help.out, HasSubstr("Examples:\n  " + name));
    EXPECT_THAT(help.out, HasSubstr("--quiet"));
    command.back() = "--version";
    EXPECT_THAT(run_fathom(command).out, StartsWith("fathom 0."));
  }
}

TEST(Help, OfTheProgramNamesEveryCommand) {
  const std::string help = run_fathom({"--help"}).out;
  for (const char* name :
       {"render", "probe", "info", "preview", "compare", "convert", "camera", "visible", "areas",
        "sun", "draw", "evaluate", "coplanar", "cast", "sees", "doctor", "depth"}) {
    EXPECT_THAT(help, HasSubstr(std::string("\n  ") + name));
  }
}

TEST(Help, ThatCannotBeWrittenIsAnError) {
  const Outcome outcome = run({"sh", "-c", "exec \"$0\" --help > /dev/full", program_path()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: standard output: "));
}

}  // namespace
}  // namespace fathom::test
