// docs/camera-files.md and docs/scene-files.md: their files and commands, and the example of every
// key.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/apps/textbook/page_examples.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAreArray;

std::string page(const std::string& name) {
  std::ifstream file(source_dir() / "docs" / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder with the meshes of a clone.
class Pages : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory_symlink(source_dir() / "data", folder_.path() / "data");
  }
  TestFolder folder_;
};

/// The JSON of a page by the name of the file that it is said to be, last before it.
std::map<std::string, std::string> files_of(const std::string& text) {
  static const std::regex name(R"(`([\w-]+\.json)`)");
  std::map<std::string, std::string> files;
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    for (std::sregex_iterator i(line.begin(), line.end(), name), end; i != end; ++i) last = (*i)[1];
    if (line != "```json") continue;
    while (std::getline(lines, line) && line != "```") files[last] += line + "\n";
  }
  return files;
}

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  return text;
}

void run_examples(const std::string& text, const TestFolder& folder) {
  for (const auto& [name, content] : files_of(text)) folder.write(name, content);
  std::istringstream lines(text);
  for (const auto& [command, printed] : examples_of(lines)) {
    const Outcome outcome = run_in_shell(command, folder.path());
    EXPECT_EQ(outcome.status, 0) << command;
    EXPECT_EQ(without_blanks(outcome.out + outcome.err), without_blanks(printed)) << command;
  }
}

/// The keys of the tables below each other, each with its example, read as JSON.
std::vector<std::pair<std::string, Json>> keys_of(const std::string& text) {
  static const std::regex row(R"(\| `(\w+)` \|.*\| `("[^`]*)` \|)");
  std::vector<std::pair<std::string, Json>> keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, row)) continue;
    const Json example = Json::parse("{" + found[2].str() + "}");
    EXPECT_TRUE(example.contains(found[1].str())) << line;
    keys.emplace_back(found[1], example);
  }
  return keys;
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, Json>>& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const auto& [key, example] : keys) names.push_back(key);
  return names;
}

TEST_F(Pages, TheFilesAndCommandsOfCameraFilesWork) {
  EXPECT_EQ(files_of(page("camera-files.md")).size(), 7U);
  run_examples(page("camera-files.md"), folder_);
}

TEST_F(Pages, TheFilesAndCommandsOfSceneFilesWork) {
  EXPECT_EQ(files_of(page("scene-files.md")).size(), 2U);
  run_examples(page("scene-files.md"), folder_);
}

/// Each key in a camera that has it in place of what it excludes.
TEST_F(Pages, EveryKeyOfACameraFileHasAnExampleThatIsRead) {
  const std::string text = page("camera-files.md");
  const auto keys = keys_of(text);
  const std::vector<std::string> all{"width",
                                     "height",
                                     "projection",
                                     "fx",
                                     "fy",
                                     "cx",
                                     "cy",
                                     "skew",
                                     "K",
                                     "pixel_centre",
                                     "pixel_center",
                                     "world_to_camera",
                                     "camera_to_world",
                                     "near",
                                     "far",
                                     "name"};
  EXPECT_THAT(names_of(keys), ElementsAreArray(all));
  const std::map<std::string, std::set<std::string>> excluded{
      {"K", {"fx", "fy", "cx", "cy", "skew"}},
      {"pixel_center", {"pixel_centre"}},
      {"camera_to_world", {"world_to_camera"}}};
  for (const auto& [key, example] : keys) {
    Json camera = Json::parse(files_of(text).at("camera.json"));
    if (const auto found = excluded.find(key); found != excluded.end())
      for (const std::string& other : found->second) camera.erase(other);
    camera.update(example);
    folder_.write("one.json", camera.dump());
    const Outcome outcome = run_fathom({"info", "one.json", "--json"}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << key;
    EXPECT_EQ(outcome.err, "") << key;
    const Json read = Json::parse(outcome.out)["cameras"][0];
    if (read.contains(key)) {
      EXPECT_EQ(read[key], example[key]) << key;
    }
  }
}

/// Each key where it belongs.
TEST_F(Pages, EveryKeyOfASceneFileHasAnExampleThatIsRead) {
  const auto keys = keys_of(page("scene-files.md"));
  const std::vector<std::string> of_mesh{"file", "transform", "name", "material", "label", "draw"},
      of_draw{"depth_test", "depth_write", "colour_write", "polygon_offset", "alpha", "stencil"},
      of_stencil{"test", "reference", "mask", "write_mask", "fail", "depth_fail", "pass"};
  std::vector<std::string> all{"meshes"};
  for (const auto& part : {of_mesh, of_draw, of_stencil})
    all.insert(all.end(), part.begin(), part.end());
  EXPECT_THAT(names_of(keys), ElementsAreArray(all));
  for (const auto& [key, example] : keys) {
    Json scene = Json::parse(R"({"meshes": [{"file": "data/meshes/spot.obj"}]})");
    Json& mesh = scene["meshes"][0];
    if (key == "meshes") {
      scene.update(example);
    } else if (std::ranges::count(of_mesh, key) > 0) {
      mesh.update(example);
    } else if (std::ranges::count(of_draw, key) > 0) {
      mesh["draw"].update(example);
    } else {
      mesh["draw"]["stencil"].update(example);
    }
    folder_.write("one.json", scene.dump());
    const Outcome outcome = run_fathom({"info", "one.json"}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << key;
    EXPECT_EQ(outcome.err, "") << key;
  }
}

}  // namespace
}  // namespace fathom::test
