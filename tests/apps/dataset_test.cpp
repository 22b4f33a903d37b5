// `fathom dataset`: what it makes, what a second run makes of what is there, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <fstream>

#include "apps/jobs/manifest.h"
#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
#include "fathom/files/input_file.h"
#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string camera(const std::string& name, int x, int size = 16) {
  const std::string s = std::to_string(size);
  return R"({"width":)" + s + R"(,"height":)" + s + R"(,"fx":20,"fy":20,"cx":8,"cy":8,)" +
         (name.empty() ? "" : R"("name":")" + name + "\",") +
         R"("pixel_centre":0.5,"world_to_camera":[[1,0,0,)" + std::to_string(x) +
         R"(],[0,-1,0,0],[0,0,-1,4]]})";
}

std::string path_of(const std::vector<std::string>& cameras) {
  std::string text;
  for (const std::string& one : cameras) text += (text.empty() ? "[" : ",") + one;
  return text + "]";
}

class DataSets : public ::testing::Test {
 protected:
  DataSets() { write("cameras.json", path_of({camera("a/1.jpg", 0), camera("2.jpg", 1)})); }

  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file, std::ios::binary) << text;
  }
  std::string read(const fs::path& file) {
    return std::string(files::InputFile(folder_.path() / file).text());
  }
  Outcome make(const std::vector<std::string>& more = {},
               const std::string& pattern = "{stem}.npy") {
    std::vector<std::string> arguments{"dataset", "maps", "cameras.json", "--mesh", spot_,
                                       "--out",   "out",  "--name",       pattern};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  /// Everything below a folder: names and contents.
  std::map<std::string, std::string> all(const fs::path& below) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / below)) {
      if (!entry.is_regular_file()) continue;
      const fs::path name = fs::relative(entry.path(), folder_.path() / below);
      files[name.string()] = read(below / name);
    }
    return files;
  }

  const std::string spot_ = (source_dir() / "data/meshes/spot.obj").string();
  TestFolder folder_;
};

TEST_F(DataSets, AreTheMapsThatRenderMakes) {
  const Outcome made = make();
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "out: 2 maps, 2 made now\n");
  EXPECT_THAT(made.err, IsEmpty());
  const Outcome rendered =
      run_fathom({"render", spot_, "--camera", "cameras.json", "-o", "{stem}.npy"},
                 {.folder = folder_.path()});
  EXPECT_EQ(rendered.status, 0) << rendered.err;
  for (const char* name : {"1.npy", "2.npy"}) EXPECT_EQ(read(fs::path("out") / name), read(name));
  EXPECT_EQ(all("out").size(), 4U);  // and cameras.json, and the manifest
}

TEST_F(DataSets, ASecondRunMakesNothing) {
  ASSERT_EQ(make().status, 0);
  const auto before = all("out");
  const Outcome again = make();
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, "out: 2 maps, 0 made now\n");
  EXPECT_EQ(all("out"), before);
}

TEST_F(DataSets, WhatIsMissingDamagedOrOfOtherInputsIsMadeAgain) {
  ASSERT_EQ(make().status, 0);
  const auto before = all("out");
  fs::remove(folder_.path() / "out/1.npy");
  EXPECT_EQ(make().out, "out: 2 maps, 1 made now\n");
  EXPECT_EQ(all("out"), before);
  std::string damaged = before.at("2.npy");
  damaged[200] = static_cast<char>(damaged[200] ^ 1);
  write("out/2.npy", damaged);
  EXPECT_EQ(make().out, "out: 2 maps, 1 made now\n");
  EXPECT_EQ(all("out"), before);
  write("cameras.json", path_of({camera("a/1.jpg", 0), camera("2.jpg", 2)}));
  EXPECT_EQ(make().out, "out: 2 maps, 1 made now\n");
  EXPECT_NE(all("out").at("2.npy"), before.at("2.npy"));
  EXPECT_EQ(make({"--dtype", "float64"}).out, "out: 2 maps, 2 made now\n");
}

TEST_F(DataSets, ATornManifestLosesNoMoreThanItsLastLine) {
  ASSERT_EQ(make().status, 0);
  const auto before = all("out");
  const std::string& manifest = before.at("fathom-manifest.jsonl");
  for (std::size_t length = 0; length < manifest.size(); length += 7) {
    write("out/fathom-manifest.jsonl", manifest.substr(0, length));
    const Outcome again = make({"--overwrite"});
    ASSERT_EQ(again.status, 0) << again.err;
    ASSERT_THAT(again.err, IsEmpty()) << length;
    ASSERT_EQ(all("out"), before) << length;
  }
  write("out/fathom-manifest.jsonl", "no JSON\n" + manifest);
  const Outcome again = make();
  EXPECT_THAT(again.err, HasSubstr("line 1 is damaged"));
  EXPECT_EQ(again.out, "out: 2 maps, 0 made now\n");
  write("out/fathom-manifest.jsonl", "{\"fathom-manifest\":2}\n");
  EXPECT_THAT(make().err, HasSubstr("later version"));
}

TEST_F(DataSets, ShardsMakeTheWholeBetweenThem) {
  ASSERT_EQ(make().status, 0);
  auto whole = all("out");
  fs::remove_all(folder_.path() / "out");
  const Outcome first = make({"--shard", "1/2"});
  EXPECT_THAT(first.out, StartsWith("out: 1 map, 1 made now, of 2 in 2 shards; cameras.json is"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out/cameras.json"));
  EXPECT_EQ(make({"--shard", "2/2"}).out, "out: 1 map, 1 made now, of 2 in 2 shards\n");
  EXPECT_EQ(make().out, "out: 2 maps, 0 made now\n");
  EXPECT_EQ(all("out"), whole);
  for (const char* wrong : {"0/2", "3/2", "2", "a/b", "1/0", "-1/2", "1/2/3"}) {
    EXPECT_EQ(make({"--shard", wrong}).status, 2) << wrong;
  }
}

TEST_F(DataSets, ShardsOfAnotherOptionLeaveNothingToTheRunThatEndsThem) {
  ASSERT_EQ(make().status, 0);
  for (const char* made : {"1", "0"}) {
    for (const char* shard : {"1/2", "2/2"}) {
      const Outcome part = make({"--background", "0", "--shard", shard});
      EXPECT_THAT(part.out, StartsWith("out: 1 map, " + std::string(made) + " made now")) << shard;
    }
  }
  EXPECT_EQ(make({"--background", "0", "--shard", "1/3"}).out,
            "out: 1 map, 0 made now, of 2 in 3 shards\n");
  EXPECT_EQ(make({"--background", "0"}).out, "out: 2 maps, 0 made now\n");
  const auto resumed = all("out");
  fs::remove_all(folder_.path() / "out");
  ASSERT_EQ(make({"--background", "0"}).status, 0);
  EXPECT_EQ(all("out"), resumed);
}

TEST_F(DataSets, FilesOfOthersAreLeftAlone) {
  write("out/2.npy", "mine");
  const Outcome refused = make();
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/2.npy: exists and was not made by this command"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out/1.npy"));
  EXPECT_EQ(read("out/2.npy"), "mine");
  EXPECT_EQ(make({"--overwrite"}).status, 0);
  EXPECT_NE(read("out/2.npy"), "mine");
}

/// As all outputs do; the help of --overwrite says so.
TEST_F(DataSets, OverwritingFollowsLinksButNotToAnInput) {
  write("elsewhere.npy", "mine");
  fs::create_directory(folder_.path() / "out");
  const fs::path link = folder_.path() / "out/2.npy";
  fs::create_symlink("../elsewhere.npy", link);
  const Outcome refused = make();
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/2.npy: exists and was not made by this command"));
  EXPECT_EQ(read("elsewhere.npy"), "mine");
  ASSERT_EQ(make({"--overwrite"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read("elsewhere.npy"), read("out/2.npy"));
  EXPECT_THAT(read("elsewhere.npy"), StartsWith("\x93NUMPY"));
  const Outcome help = run_fathom({"dataset", "maps", "--help"}, {.folder = folder_.path()});
  EXPECT_THAT(help.out, HasSubstr("symbolic"));

  const std::string cameras = read("cameras.json");
  fs::remove_all(folder_.path() / "out");
  fs::create_directory(folder_.path() / "out");
  fs::create_symlink("../cameras.json", link);
  const Outcome of_input = make({"--overwrite"});
  EXPECT_EQ(of_input.status, 2);
  EXPECT_THAT(of_input.err, HasSubstr("out/2.npy: is an input of this command"));
  EXPECT_EQ(read("cameras.json"), cameras);
}

TEST_F(DataSets, TheFolderMayBeThatOfTheCameras) {
  const Outcome made = run_fathom(
      {"dataset", "maps", "cameras.json", "--mesh", spot_, "--out", ".", "--name", "{stem}.npy"},
      {.folder = folder_.path()});
  EXPECT_EQ(made.out, ".: 2 maps, 2 made now\n") << made.err;
}

TEST_F(DataSets, TwoOutputsOfOneNameAreRefused) {
  write("cameras.json", path_of({camera("cameras", 0)}));
  const Outcome refused = make({"--png-sidecar"}, "{stem}.png");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/cameras.json: would be written twice"));
}

TEST_F(DataSets, ASidecarIsBesideEachPng) {
  EXPECT_EQ(
      make({"--png-sidecar", "--png-scale", "20000", "--png-beyond", "none"}, "{stem}.png").out,
      "out: 2 maps, 2 made now\n");
  EXPECT_THAT(read("out/1.json"), HasSubstr("\"scale\": 20000"));
  EXPECT_THAT(read("out/2.json"), HasSubstr("\"beyond\": "));
}

TEST_F(DataSets, OneProcessAtATimeIsAtOneFolder) {
  ASSERT_EQ(make().status, 0);
  const fs::path manifest = folder_.path() / "out/fathom-manifest.jsonl";
  const files::Descriptor locked(::open(manifest.c_str(), O_RDONLY));
  ASSERT_EQ(::flock(locked.get(), LOCK_EX), 0);
  const Outcome refused = make();
  EXPECT_EQ(refused.status, 4);
  EXPECT_THAT(refused.err, HasSubstr("another process is at this work"));
}

TEST_F(DataSets, NamesThatAreNoPlacesBelowTheFolderAreRefused) {
  const std::pair<std::string, std::string> names[] = {{"../x.jpg", "no place below"},
                                                       {"/x.jpg", "no place below"},
                                                       {"a/../../x", "no place below"},
                                                       {"", "has no name"},
                                                       {"2.jpg", "would both be written as"}};
  for (const auto& [name, words] : names) {
    write("cameras.json", path_of({camera("2.jpg", 0), camera(name, 1)}));
    const Outcome refused = make({}, "{name}.npy");
    EXPECT_TRUE(refused.status == 2 || refused.status == 3) << name;
    EXPECT_THAT(refused.err, HasSubstr(words)) << name;
    EXPECT_FALSE(fs::exists(folder_.path() / "out")) << name;
  }
}

TEST_F(DataSets, CamerasMayDifferInSize) {
  write("cameras.json", path_of({camera("1.jpg", 0, 16), camera("2.jpg", 0, 32)}));
  EXPECT_EQ(make().status, 0);
  EXPECT_EQ(read("out/1.npy").size(), 128 + 4 * 16 * 16U);
  EXPECT_EQ(read("out/2.npy").size(), 128 + 4 * 32 * 32U);
}

TEST_F(DataSets, ACameraThatIsTooLargeIsRefusedBeforeTheFirstMap) {
  for (const bool last : {false, true}) {
    std::vector<std::string> cameras{camera("1.jpg", 0), camera("2.jpg", 0)};
    cameras.insert(last ? cameras.end() : cameras.begin(), camera("3.jpg", 0, 2000000));
    write("cameras.json", path_of(cameras));
    const Outcome refused = make();
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.err, HasSubstr("an image of 2000000x2000000 pixels needs"));
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  }
}

TEST_F(DataSets, AFullDiskLosesNothingThatIsFinished) {
  write("cameras.json", path_of({camera("1.jpg", 0, 16), camera("2.jpg", 0, 64)}));
  RunOptions options{.folder = folder_.path()};
  options.file_size = 8192;  // the second map is larger
  const std::vector<std::string> arguments{"dataset", "maps", "cameras.json", "--mesh",    spot_,
                                           "--out",   "out",  "--name",       "{stem}.npy"};
  const Outcome full = run_fathom(arguments, options);
  EXPECT_EQ(full.status, 4);
  EXPECT_THAT(full.err, HasSubstr("out/2.npy"));
  EXPECT_THAT(full.err, HasSubstr("of 2 maps are finished"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out/2.npy"));
  EXPECT_EQ(run_fathom(arguments, {.folder = folder_.path()}).status, 0);
  const auto resumed = all("out");
  fs::remove_all(folder_.path() / "out");
  EXPECT_EQ(run_fathom(arguments, {.folder = folder_.path()}).status, 0);
  EXPECT_EQ(all("out"), resumed);
}

TEST(Manifests, SayWhatWasSaidLast) {
  const app::Record first{"key 1", {{"a", 1, 2}}, "{}"},
      second{"key 2", {{"a", 3, 4}}, "{\"n\":1}"};
  app::ManifestContent content;
  Warnings warnings;
  content.add(app::line_of(first) + "{\"announced\":[\"b\"]}\n" + app::line_of(second), "m",
              warnings);
  EXPECT_THAT(warnings, IsEmpty());
  ASSERT_NE(content.find("a", "key 2"), nullptr);
  EXPECT_EQ(content.find("a", "key 1"), nullptr);
  EXPECT_EQ(content.find("b", "key 2"), nullptr);
  EXPECT_EQ(content.find("a", "key 2")->files.at(0).crc32, 4U);
  EXPECT_EQ(content.find("a", "key 2")->facts, "{\"n\":1}");
  EXPECT_TRUE(content.owned.contains("b"));
  // One manifest does not know what another one says, nor when; what is published now is known.
  content.add(app::line_of(first), "n", warnings);
  EXPECT_NE(content.find("a", "key 1"), nullptr);
  EXPECT_NE(content.find("a", "key 2"), nullptr);
  content.add(first);
  EXPECT_EQ(content.find("a", "key 2"), nullptr);
  const std::string deep = std::string(200, '[') + std::string(200, ']');
  for (const char* wrong : {"[]", "{}", "{\"key\":1}", "{\"key\":\"\",\"files\":[],\"facts\":{}}",
                            "{\"key\":\"\",\"files\":[{\"path\":\"a\"}],\"facts\":{}}", "\xff",
                            deep.c_str(), "{\"announced\":3}", "{\"fathom-manifest\":\"x\"}", ""}) {
    Warnings told;
    content.add(std::string(wrong) + "\n" + app::line_of(first), "m", told);
    EXPECT_EQ(told.size(), 1U) << wrong;
  }
}

}  // namespace
}  // namespace fathom::test
