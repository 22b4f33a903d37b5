// Where a glTF asset's buffers may lie: in its folder, unless its reader says otherwise.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/mesh_files/gltf/gltf_asset.h"

namespace fathom {
namespace {

using namespace checks;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// asset/x.gltf, whose buffer has a URI that a test gives, and secret.bin beside the folder.
class GltfOutsideFiles : public ::testing::Test {
 protected:
  GltfOutsideFiles() {
    std::filesystem::create_directories(asset_folder / "sub");
    folder.write("secret.bin", buffer());
  }
  static std::string buffer() { return five({{"mode", 5}}).buffer; }

  [[nodiscard]] Read read_uri(const std::string& uri, bool outside_files = false) const {
    json tree = five({{"mode", 5}}).done();
    tree["buffers"][0]["uri"] = uri;
    ReadOptions options;
    options.outside_files = outside_files;
    return read_bytes(tree.dump(), asset_folder / "x.gltf", options);
  }
  [[nodiscard]] std::string fault_of_uri(const std::string& uri, bool outside_files = false) const {
    return message_of<InputError>([&] { (void)read_uri(uri, outside_files); });
  }
  void write_inside(const std::string& name) const { folder.write("asset/" + name, buffer()); }

  ScratchFolder folder;
  std::filesystem::path asset_folder = folder.path() / "asset";
};

TEST_F(GltfOutsideFiles, AreRefusedHoweverTheyAreWritten) {
  const std::string absolute = (folder.path() / "secret.bin").string();
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"),
        std::string("%2E%2E%2Fsecret.bin"), std::string("sub/../../secret.bin"),
        std::string("./.././secret.bin"), std::string("none/../../secret.bin"), absolute,
        "/" + absolute, std::string("/etc/passwd"), std::string("%2fetc%2fpasswd"),
        std::string("/proc/self/environ"), std::string("../"), std::string("/dev/zero"),
        std::string("..\\secret.bin"), std::string("sub\\..\\..\\secret.bin"),
        // What lies outside is refused whether it is there or not.
        std::string("../none.bin"), std::string("/none/none.bin")}) {
    EXPECT_THAT(fault_of_uri(uri),
                AllOf(HasSubstr("x.gltf: buffers[0].uri: leads out of the folder of the asset"),
                      HasSubstr("--outside-files")))
        << uri;
  }
}

TEST_F(GltfOutsideFiles, AreNoURIsOfAnotherScheme) {
  const std::string absolute = (folder.path() / "secret.bin").string();
  for (const bool outside_files : {false, true})
    for (const std::string& uri : {"file://" + absolute, "https://example.org" + absolute})
      EXPECT_THAT(fault_of_uri(uri, outside_files), HasSubstr("expected a file's relative URI"));
  // Names within the folder, though they look like something else.
  EXPECT_THAT(fault_of_uri("file:" + absolute), HasSubstr("there is no file"));
  EXPECT_THAT(fault_of_uri("C:\\secret.bin"), HasSubstr("there is no file"));
}

TEST_F(GltfOutsideFiles, AreRefusedBehindSymbolicLinks) {
  std::filesystem::create_symlink("../secret.bin", asset_folder / "link.bin");
  std::filesystem::create_directory_symlink("..", asset_folder / "up");
  for (const char* uri : {"link.bin", "up/secret.bin", "sub/../link.bin"})
    EXPECT_THAT(fault_of_uri(uri), AllOf(HasSubstr("lies outside"), HasSubstr("--outside-files")))
        << uri;
  // A link that goes up from where it leads.
  std::filesystem::create_directory_symlink("/usr/bin", asset_folder / "far");
  EXPECT_THAT(fault_of_uri("far/../../etc/passwd"), HasSubstr("leads out of the folder"));
}

TEST_F(GltfOutsideFiles, AreReadWhereTheyAreAskedFor) {
  std::filesystem::create_symlink("../secret.bin", asset_folder / "link.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("link.bin"),
        std::string("..\\secret.bin"), (folder.path() / "secret.bin").string()})
    EXPECT_EQ(read_uri(uri, true).scene.meshes.at(0).triangles.size(), 3U) << uri;
}

TEST_F(GltfOutsideFiles, InsideAreAllOthers) {
  write_inside("a.bin");
  write_inside("sub/b.bin");
  write_inside("a b.bin");
  write_inside("back\\slash.bin");
  std::filesystem::create_symlink("sub/b.bin", asset_folder / "link.bin");
  for (const std::string& uri :
       {std::string("a.bin"), std::string("./a.bin"), std::string("sub/b.bin"),
        std::string("sub/../a.bin"), std::string("a%20b.bin"), std::string("a b.bin"),
        std::string("link.bin"), std::string("../asset/a.bin"), (asset_folder / "a.bin").string(),
        // Written by exporters on Windows; and a file that does have a backslash in its name.
        std::string("sub\\b.bin"), std::string("back\\slash.bin")})
    EXPECT_EQ(read_uri(uri).scene.meshes.at(0).triangles.size(), 3U) << uri;
}

TEST_F(GltfOutsideFiles, TheFolderMayBeReachedByALink) {
  write_inside("a.bin");
  std::filesystem::create_directory_symlink("asset", folder.path() / "link");
  asset_folder = folder.path() / "link";
  EXPECT_EQ(read_uri("a.bin").scene.meshes.at(0).triangles.size(), 3U);
  EXPECT_THAT(fault_of_uri("../secret.bin"), HasSubstr("leads out"));
}

TEST_F(GltfOutsideFiles, PipesAndDevicesAreNeverOpened) {
  ASSERT_EQ(::mkfifo((asset_folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", asset_folder / "zeros");
  for (const bool outside_files : {false, true})
    EXPECT_THAT(fault_of_uri("pipe", outside_files), HasSubstr("is not a regular file"));
  EXPECT_THAT(fault_of_uri("zeros", true), HasSubstr("is not a regular file"));
  EXPECT_THAT(fault_of_uri("zeros"), HasSubstr("lies outside"));
  EXPECT_THAT(fault_of_uri("sub"), HasSubstr("is a directory"));
}

TEST_F(GltfOutsideFiles, NoMessageTellsWhatIsInAFile) {
  folder.write("asset/a.bin", "TopSecret");
  EXPECT_THAT(fault_of_uri("a.bin"), AllOf(HasSubstr("found 9"), Not(HasSubstr("TopSecret"))));
}

}  // namespace
}  // namespace fathom
