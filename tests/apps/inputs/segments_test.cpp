// Materials, groups, parts and labels through the program: rendered, listed, probed, as mattes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "fathom/image/map_files.h"
#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

/// The square of square.obj as two triangles, each of a material of its own.
constexpr const char* two_materials =
    "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\n"
    "o sheet\nusemtl dark oak\nf 1 2 3\nusemtl steel\nf 1 3 4\n";

class SegmentsOfTheProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("two.obj", two_materials);
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }
  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  Outcome render(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"render", "--camera", "camera.json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return fathom(all);
  }
  DepthMap map_of(const std::string& file) const { return read_map(folder_ / file); }

  TestFolder folder_;
};

TEST_F(SegmentsOfTheProgram, AreRenderedAndListed) {
  const Outcome rendered = render({"two.obj", "--channels", "id,material,part", "-o", "map.exr"});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_EQ(rendered.err, "");
  const DepthMap map = map_of("map.exr");
  EXPECT_THAT(map.tables.at("material"), ElementsAre("dark oak", "steel"));
  const auto& ids = *map.values<std::uint32_t>("id");
  const auto& materials = *map.values<std::uint32_t>("material");
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), materials.begin()));
  EXPECT_THAT(fathom({"info", "map.exr"}).out, HasSubstr("  materials  dark oak, steel\n"));
  EXPECT_THAT(Json::parse(fathom({"info", "map.exr", "--json"}).out).at("materials"),
              Json({"dark oak", "steel"}));
  EXPECT_THAT(fathom({"info", "two.obj"}).out,
              HasSubstr("  materials  dark oak, steel\n  parts      sheet\n"));
  EXPECT_THAT(Json::parse(fathom({"info", "two.obj", "--json"}).out).at("parts"), Json({"sheet"}));
}

TEST_F(SegmentsOfTheProgram, ThatAreMissingAreSaidToBe) {
  const Outcome rendered =
      render({"square.obj", "--channels", "Z,material,label", "-o", "map.exr"});
  EXPECT_EQ(rendered.status, 0);
  EXPECT_EQ(rendered.err,
            "fathom: warning: no triangle of the scene has a material: channel material is "
            "4294967294 at all surfaces\n"
            "fathom: warning: no triangle of the scene has a label: channel label is 4294967294 at "
            "all surfaces\n");
  EXPECT_THAT(fathom({"info", "map.exr"}).out, HasSubstr(" without one\n"));
  EXPECT_GT(Json::parse(fathom({"info", "map.exr", "--json"}).out)
                .at("channels")
                .at("label")
                .at("none")
                .get<int>(),
            0);
}

TEST_F(SegmentsOfTheProgram, AreProbed) {
  const std::vector<std::string> probe{"probe",       "two.obj", "--camera",
                                       "camera.json", "--pixel", "4,3"};
  EXPECT_THAT(fathom(probe).out, HasSubstr("  material dark oak, part sheet\n"));
  std::vector<std::string> in_json = probe;
  in_json.emplace_back("--json");
  const Json triangle = Json::parse(fathom(in_json).out).at("triangles").at(0);
  EXPECT_EQ(triangle.at("material"), "dark oak");
  EXPECT_EQ(triangle.at("part"), "sheet");
  EXPECT_TRUE(triangle.at("group").is_null() && triangle.at("label").is_null());
}

TEST_F(SegmentsOfTheProgram, MakeMattes) {
  ASSERT_EQ(render({"two.obj", "--cryptomatte-by", "material,object", "-o", "map.exr"}).status, 0);
  const DepthMap map = map_of("map.exr");
  const Json manifest = Json::parse(map.texts.at("cryptomatte/be359d6/manifest"));
  EXPECT_EQ(map.texts.at("cryptomatte/be359d6/name"), "CryptoMaterial");
  EXPECT_EQ(manifest.size(), 2U);
  EXPECT_TRUE(manifest.contains("dark oak") && manifest.contains("steel"));
  EXPECT_NE(map.find("CryptoObject00.R"), nullptr);
  // The two triangles cover the square: what they cover of each pixel adds up to A.
  const auto& areas = *map.values<float>("A");
  const auto& first = *map.values<float>("CryptoMaterial00.G");
  const auto& second = *map.values<float>("CryptoMaterial00.A");
  bool both = false;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    EXPECT_FLOAT_EQ(first[i] + second[i], areas[i]);
    both = both || (first[i] > 0 && second[i] > 0);
  }
  EXPECT_TRUE(both);
  // What has no name has the empty one.
  ASSERT_EQ(render({"square.obj", "--cryptomatte-by", "part", "-o", "none.exr"}).status, 0);
  bool found = false;
  for (const auto& [key, text] : map_of("none.exr").texts)
    found = found || (key.ends_with("/manifest") && Json::parse(text) == Json{{"", "00800000"}});
  EXPECT_TRUE(found);
}

TEST_F(SegmentsOfTheProgram, AreThoseOfSceneFiles) {
  folder_.write("scene.json",
                R"({"meshes": [{"file": "two.obj", "material": "glass", "label": 65533}]})");
  ASSERT_EQ(render({"scene.json", "--channels", "label", "-o", "map.png"}).status, 0);
  const DepthMap map = map_of("map.png");
  const auto& labels = *map.values<std::uint32_t>("label");
  EXPECT_THAT(std::set<std::uint32_t>(labels.begin(), labels.end()),
              ElementsAre(65533, no_surface));
}

TEST_F(SegmentsOfTheProgram, OfTheExactEnginesAndThePipelineAreTheSame) {
  const std::vector<std::string> channels{"two.obj", "--channels", "material,part,group", "-o"};
  for (const char* engine : {"fast", "reference", "pipeline"}) {
    std::vector<std::string> arguments = channels;
    arguments.insert(arguments.end(), {std::string(engine) + ".exr", "--engine", engine});
    ASSERT_EQ(render(arguments).status, 0) << engine;
  }
  for (const char* engine : {"reference", "pipeline"}) {
    const DepthMap fast = map_of("fast.exr"), other = map_of(std::string(engine) + ".exr");
    EXPECT_EQ(fast.tables, other.tables);
    EXPECT_EQ(fathom({"compare", "fast.exr", std::string(engine) + ".exr"}).status, 0) << engine;
  }
}

}  // namespace
}  // namespace fathom::test
