// Names that are not UTF-8 work like any other; names that could have effects on a terminal reach
// none.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/faults.h"
#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string not_utf8 = "n\xff\xc0\x80me";
const std::string replaced = "n\uFFFD\uFFFD\uFFFDme";

/// Moves a cursor, colours, ends a line, forges one, turns the direction of writing.
const std::string effects =
    "\x1b[31m\r\b\x7f"
    "\u0085\u009b2J\u202e\u2066\u200f\u2028\x9b"
    "1m";

class Names : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }
  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  /// The text is UTF-8 and has no effects beyond line feeds.
  static void expect_harmless(const std::string& text) {
    for (const char* const effect :
         {"\x1b", "\r", "\b", "\x7f", "\u0085", "\u009b", "\u202e", "\u2066", "\u200f", "\u2028"}) {
      EXPECT_EQ(text.find(effect), std::string::npos)
          << Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
    }
    EXPECT_NO_THROW(Json(text).dump());
  }

  TestFolder folder_;
};

TEST_F(Names, OutputsThatAreNotUtf8) {
  const Outcome outcome =
      fathom({"render", "square.obj", "--camera", "camera.json", "-o", not_utf8 + ".exr", "--stats",
              not_utf8 + ".stats", "--save-camera", not_utf8 + ".camera"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* const suffix : {".exr", ".stats", ".camera"}) {
    EXPECT_TRUE(fs::exists(folder_ / (not_utf8 + suffix))) << suffix;
  }
  const Json stats = Json::parse(folder_.read(not_utf8 + ".stats"));
  EXPECT_EQ(stats.at("map"), replaced + ".exr");
}

TEST_F(Names, InputsThatAreNotUtf8) {
  folder_.write(not_utf8 + ".obj", square_obj);
  folder_.write(not_utf8 + ".json", square_camera);
  const std::string mesh = not_utf8 + ".obj", camera = not_utf8 + ".json", map = not_utf8 + ".exr";
  const std::vector<std::vector<std::string>> commands{
      {"render", mesh, "--camera", camera, "-o", map},
      {"render", mesh, "--camera", camera, "--cryptomatte", "--channels", "Z,object", "-o", map},
      {"render", mesh, "--camera", camera, "--deep", "-o", "deep-" + map},
      {"render", mesh, "--camera", camera, "-o", not_utf8 + ".png"},
      {"info", mesh},
      {"info", mesh, "--json"},
      {"info", camera, "--json"},
      {"info", map},
      {"info", map, "--json"},
      {"probe", mesh, "--camera", camera, "--pixel", "3,3"},
      {"probe", mesh, "--camera", camera, "--pixel", "3,3", "--json"},
      {"visible", mesh, "--camera", camera},
      {"visible", mesh, "--camera", camera, "--json"},
      {"visible", mesh, "--camera", camera, "--csv", "-o", not_utf8 + ".csv"},
      {"coplanar", mesh, mesh, "--camera", camera, "--json"},
      {"compare", map, map, "--json", not_utf8 + ".report"},
      {"compare", map, map, "--json", "-", "--heatmap", not_utf8 + "-differences.png"},
      {"preview", map, "-o", not_utf8 + "-preview.png"},
      {"convert", map, "-o", not_utf8 + ".ply"}};
  for (const auto& command : commands) {
    const Outcome outcome = fathom(command);
    EXPECT_EQ(outcome.status, 0) << command[0] << ": " << outcome.err;
    expect_harmless(outcome.out);
  }
}

TEST_F(Names, ArgumentsThatAreNotUtf8AreRefusedInOneLine) {
  const std::vector<std::vector<std::string>> commands{
      {"render", not_utf8, "-o", "map.exr"},
      {"render", "square.obj", "-o", not_utf8},
      {"render", "square.obj", "-o", "map.exr", "--camera", not_utf8},
      {"render", "square.obj", "-o", "map.exr", "--channels", not_utf8},
      {"render", "square.obj", "-o", "map.exr", "--size", not_utf8},
      {"render", "square.obj", "-o", not_utf8 + "{index:q}.exr"},
      {not_utf8},
      {"--" + not_utf8},
      {"info", not_utf8}};
  for (const auto& command : commands) {
    const Outcome outcome = fathom(command);
    EXPECT_THAT(outcome.status, AnyOf(2, 3, 4)) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
    EXPECT_NO_THROW(Json(outcome.err).dump());
  }
}

TEST_F(Names, OfFilesReachNoTerminal) {
  const std::string name = "a" + effects + "\nfathom: error: forged";
  folder_.write(name + ".obj", square_obj);
  folder_.write(name + ".bad", "f 1 2 3\n");
  const std::string mesh = name + ".obj", map = name + ".exr";
  const std::vector<std::vector<std::string>> commands{
      {"render", mesh, "--camera", "camera.json", "--channels", "Z,object", "-o", map},
      {"info", mesh},
      {"info", mesh, "--json"},
      {"info", map},
      {"info", map, "--json"},
      {"probe", mesh, "--camera", "camera.json", "--pixel", "3,3"},
      {"probe", mesh, "--camera", "camera.json", "--pixel", "3,3", "--json"},
      {"visible", mesh, "--camera", "camera.json"},
      {"visible", mesh, "--camera", "camera.json", "--json"},
      {"visible", mesh, "--camera", "camera.json", "--csv"},
      {"coplanar", mesh, mesh, "--camera", "camera.json"},
      {"compare", map, map},
      {"info", name + ".bad"},
      {"info", name + ".none"},
      {"render", "square.obj", "-o", name},
      {"render", "square.obj", "-o", "map.exr", "--up", name},
      {name}};
  for (const auto& command : commands) {
    const Outcome outcome = fathom(command);
    expect_harmless(outcome.out);
    expect_harmless(outcome.err);
    EXPECT_EQ(outcome.out.find("\nfathom: error: forged"), std::string::npos) << command[0];
    EXPECT_EQ(outcome.err.find("\nfathom: error: forged"), std::string::npos) << command[0];
    EXPECT_LE(lines_of(outcome.err), 1) << outcome.err;
  }
}

/// As OBJ words, keys of JSON, names of glTF meshes and texts of maps.
TEST_F(Names, WithinFilesReachNoTerminal) {
  const Json scene{{"meshes", {{{"file", "square.obj"}, {"name", "x\u001b[2J\u009b\u202e\ny"}}}}};
  folder_.write("scene.json", scene.dump());
  folder_.write("key.json", R"({"meshes": [], "\u001b[2J\u009b\u202e\ny": 1})");
  folder_.write("camera-key.json", camera_with("\u202e\u009bkey", "1"));
  folder_.write("word.obj", "v 1 2 3\nsurf\x1b[2J\xc2\x9b\xe2\x80\xae 1\nv a\x1b[2J\xc2\x9b 1 2\n");
  const std::string name = "a\x1b[2J\r\xc2\x9b\xe2\x80\xae\b\xff";
  std::string segments = square_obj;
  segments.insert(0, "usemtl " + name + "\ng " + name + "\no " + name + "\n");
  folder_.write("segments.obj", segments);
  const std::vector<std::vector<std::string>> commands{
      {"render", "scene.json", "--camera", "camera.json", "--channels", "Z,object", "--cryptomatte",
       "-o", "map.exr"},
      {"info", "scene.json"},
      {"info", "scene.json", "--json"},
      {"info", "map.exr"},
      {"info", "map.exr", "--json"},
      {"visible", "scene.json", "--camera", "camera.json"},
      {"visible", "scene.json", "--camera", "camera.json", "--csv"},
      {"visible", "scene.json", "--camera", "camera.json", "--json"},
      {"coplanar", "scene.json", "scene.json", "--camera", "camera.json"},
      {"coplanar", "scene.json", "scene.json", "--camera", "camera.json", "--json"},
      {"info", "key.json"},
      {"info", "camera-key.json"},
      {"info", "word.obj"},
      {"info", "segments.obj"},
      {"info", "segments.obj", "--json"},
      {"render", "segments.obj", "--camera", "camera.json", "--channels",
       "Z,material,group,part,label", "--cryptomatte-by", "material", "-o", "segments.exr"},
      {"info", "segments.exr"},
      {"info", "segments.exr", "--json"},
      {"probe", "segments.obj", "--camera", "camera.json", "--pixel", "3,3"},
      {"probe", "segments.obj", "--camera", "camera.json", "--pixel", "3,3", "--json"},
      {"preview", "segments.exr", "--channel", "material", "-o", "segments.png"}};
  for (const auto& command : commands) {
    const Outcome outcome = fathom(command);
    expect_harmless(outcome.out);
    expect_harmless(outcome.err);
    EXPECT_LE(lines_of(outcome.err), 2) << outcome.err;
    EXPECT_EQ(outcome.out.find("\ny"), std::string::npos) << command[0] << outcome.out;
  }
  // JSON keeps the name: escapes are its own.
  const Json info = Json::parse(fathom({"info", "scene.json", "--json"}).out);
  EXPECT_EQ(info.at("objects")[0].at("name"), "x\u001b[2J\u009b\u202e\ny");
}

/// A text of a map that looks like JSON: answering in JSON does not run out of stack.
TEST_F(Names, OfMapsMayHaveTextsThatAreNestedDeeply) {
  ASSERT_EQ(fathom({"render", "square.obj", "--camera", "camera.json", "-o", "map.exr"}).status, 0);
  const std::string deep = std::string(60000, '[') + std::string(60000, ']');
  ASSERT_EQ(run({"oiiotool", "map.exr", "--attrib", "fathom.camera", deep, "-o", "deep.exr"},
                {.folder = folder_.path()})
                .status,
            0);
  const Outcome outcome = fathom({"info", "deep.exr", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("attributes").at("fathom.camera"), deep);
}

}  // namespace
}  // namespace fathom::test
