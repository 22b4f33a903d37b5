// What a scene file may name: regular files, in a folder if the user says so. What is recorded of
// them are the paths that were given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A scene file "inside/scene.json" that names `file`.
class NamedFiles : public ::testing::Test {
 protected:
  NamedFiles() {
    std::filesystem::create_directory(folder.path() / "inside");
    folder.write("inside/own.obj", triangle);
    folder.write("outside.obj", triangle);
  }
  Scene read(const std::string& file, const std::filesystem::path& confine = {}) {
    const auto scene =
        folder.write("inside/scene.json", R"({"meshes": [{"file": ")" + file + R"("}]})");
    ReadOptions options;
    options.confine = confine;
    return read_scene({scene}, options, warnings);
  }
  std::string refusal(const std::string& file, const std::filesystem::path& confine = {}) {
    return message_of<InputError>([&] { read(file, confine); });
  }

  ScratchFolder folder;
  std::filesystem::path inside = folder.path() / "inside";
  Warnings warnings;
};

TEST_F(NamedFiles, ReachOutOfTheFolderUnlessConfined) {
  EXPECT_EQ(triangle_count(read("../outside.obj")), 1U);
  EXPECT_EQ(triangle_count(read("../outside.obj", folder.path())), 1U);
  EXPECT_EQ(refusal("../outside.obj", inside),
            (inside / "../outside.obj").string() + ": lies outside " + inside.string() +
                ", to which files named by other files are confined");
  EXPECT_EQ(triangle_count(read("own.obj", inside)), 1U);
  EXPECT_THAT(refusal("/etc/passwd", inside), HasSubstr("lies outside"));
}

TEST_F(NamedFiles, LinksCountWhereTheyLead) {
  std::filesystem::create_symlink("../outside.obj", inside / "link.obj");
  EXPECT_EQ(triangle_count(read("link.obj")), 1U);
  EXPECT_THAT(refusal("link.obj", inside), HasSubstr("lies outside"));
}

/// What the user names himself is no file's doing.
TEST_F(NamedFiles, TheUsersOwnPathsAreNotConfined) {
  ReadOptions options;
  options.confine = inside;
  EXPECT_EQ(triangle_count(read_scene({folder.path() / "outside.obj"}, options, warnings)), 1U);
}

TEST_F(NamedFiles, BuffersOfAnAssetAreConfinedToo) {
  const std::string asset = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "link.bin"}]})";
  folder.write("outside.bin", std::string(36, '\0'));
  std::filesystem::create_symlink("../outside.bin", inside / "link.bin");
  const auto file = folder.write("inside/asset.gltf", asset);
  ReadOptions options;
  options.confine = inside;
  EXPECT_THAT(message_of<InputError>([&] { read_scene({file}, options, warnings); }),
              HasSubstr("link.bin: lies outside"));
  EXPECT_THAT(refusal("asset.gltf", inside), HasSubstr("link.bin: lies outside"));
  options.confine = folder.path();
  options.outside_files = true;
  EXPECT_EQ(triangle_count(read_scene({file}, options, warnings)), 1U);
}

/// A pipe that nobody writes to would be waited for without end, a device read without end.
TEST_F(NamedFiles, PipesAndDevicesAreRefused) {
  ASSERT_EQ(mkfifo((inside / "pipe.obj").c_str(), 0600), 0);
  EXPECT_THAT(refusal("pipe.obj"), HasSubstr("pipe.obj: is not a regular file"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("/dev/zero: is not a regular file"));
  EXPECT_THAT(refusal("."), HasSubstr("is a directory"));
}

/// Maps tell where they come from in the words of their user, wherever the machine keeps the files.
TEST_F(NamedFiles, AreRecordedAsTheyAreGiven) {
  const auto before = std::filesystem::current_path();
  folder.write("inside/scene.json",
               R"({"meshes": [{"file": "../outside.obj"}, {"file": "./own.obj"}]})");
  std::filesystem::current_path(folder.path());
  const auto sources = [&](const char* file) {
    std::vector<std::string> paths;
    for (const Source& source : read_scene({file}, {}, warnings).sources)
      paths.push_back(source.path);
    return paths;
  };
  using Paths = std::vector<std::string>;
  EXPECT_EQ(sources("inside/scene.json"),
            (Paths{"inside/scene.json", "inside/../outside.obj", "inside/./own.obj"}));
  std::filesystem::current_path(inside);
  EXPECT_EQ(sources("scene.json"), (Paths{"scene.json", "../outside.obj", "./own.obj"}));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace fathom
