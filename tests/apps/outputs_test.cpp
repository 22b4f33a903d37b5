// Where outputs go: beside their place first, renamed at the end; through links, into devices and
// pipes; nothing left behind and an older file intact where it fails.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "fathom/text/version.h"
#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Outputs : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }

  Outcome render_to(const std::string& output, RunOptions options = {}) const {
    options.folder = folder_.path();
    return run_fathom({"render", "square.obj", "--camera", "camera.json", "-o", output}, options);
  }

  /// Fails with status 4 in one line that begins with the output's name, and leaves nothing.
  void expect_failure(const std::string& output, const std::string& said,
                      const RunOptions& options = {}) {
    const auto before = folder_.names();
    const Outcome outcome = render_to(output, options);
    EXPECT_EQ(outcome.status, 4);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(StartsWith("fathom: error: " + output + ": "), HasSubstr(said)));
    EXPECT_EQ(folder_.names(), before);
  }

  /// A command whose output cannot be written in full leaves the older one and nothing else.
  void expect_kept(std::vector<std::string> command, const std::string& output) {
    folder_.write(output, "older");
    const auto before = folder_.names();
    command.push_back(output);
    const Outcome outcome = run_fathom(command, {.folder = folder_.path(), .file_size = 150});
    EXPECT_EQ(outcome.status, 4) << command[0] << " " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(folder_.read(output), "older");
    EXPECT_EQ(folder_.names(), before);
  }

  [[nodiscard]] mode_t mode_of(const std::string& name) const {
    struct stat status {};
    ::stat((folder_ / name).c_str(), &status);
    return status.st_mode & 07777;
  }

  TestFolder folder_;
};

const std::string exr_magic = "\x76\x2f\x31\x01";

TEST_F(Outputs, ReplaceAnOlderFileAndKeepItsPermissions) {
  folder_.write("map.exr", "older");
  ::chmod((folder_ / "map.exr").c_str(), 0640);
  ASSERT_EQ(render_to("map.exr").status, 0);
  EXPECT_THAT(folder_.read("map.exr"), StartsWith(exr_magic));
  EXPECT_EQ(mode_of("map.exr"), 0640U);
}

TEST_F(Outputs, NewFilesHaveThePermissionsOfTheUmask) {
  const mode_t before = ::umask(027);
  const Outcome outcome = render_to("map.exr");
  ::umask(before);
  ASSERT_EQ(outcome.status, 0);
  EXPECT_EQ(mode_of("map.exr"), 0640U);
}

TEST_F(Outputs, FollowASymbolicLink) {
  folder_.write("real.exr", "older");
  fs::create_symlink("real.exr", folder_ / "link.exr");
  ASSERT_EQ(render_to("link.exr").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.exr"));
  EXPECT_THAT(folder_.read("real.exr"), StartsWith(exr_magic));
}

TEST_F(Outputs, FollowASymbolicLinkToAFileThatIsNotThereYet) {
  fs::create_directory(folder_ / "maps");
  fs::create_symlink("maps/real.exr", folder_ / "link.exr");
  ASSERT_EQ(render_to("link.exr").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.exr"));
  EXPECT_THAT(folder_.read("maps/real.exr"), StartsWith(exr_magic));
}

TEST_F(Outputs, ContainTheVersionThatTheEnvironmentNames) {
  const RunOptions replaced{.folder = folder_.path(),
                            .prepare = [] { ::setenv(text::version_variable, "9.8-test", 1); }};
  const RunOptions plain{.folder = folder_.path(),
                         .prepare = [] { ::setenv(text::version_variable, "", 1); }};
  folder_.write(
      "down.json",
      R"({"width": 8, "height": 6, "fx": 2, "fy": 2, "cx": 4, "cy": 3, "pixel_centre": 0.5,
                    "projection": "orthographic",
                    "world_to_camera": [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 5]]})");
  for (const std::string name : {"map.exr", "map.png", "map.npz", "map.tif", "view.png"}) {
    std::vector<std::string> command{"render", "square.obj", "--camera", "down.json"};
    if (name == "view.png") command = {"preview", "map.exr"};
    command.insert(command.end(), {"-o", name});
    ASSERT_EQ(run_fathom(command, replaced).status, 0) << name;
    EXPECT_THAT(folder_.read(name), HasSubstr("Fathom 9.8-test")) << name;
    ASSERT_EQ(run_fathom(command, plain).status, 0) << name;
    EXPECT_THAT(folder_.read(name), AllOf(HasSubstr("Fathom "), Not(HasSubstr("9.8-test"))))
        << name;
  }
}

TEST_F(Outputs, RefuseALinkToItself) {
  fs::create_symlink("link.exr", folder_ / "link.exr");
  expect_failure("link.exr", "symbolic links");
}

TEST_F(Outputs, WriteThroughADevice) {
  fs::create_symlink("/dev/null", folder_ / "map.exr");
  const Outcome outcome = render_to("map.exr");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "map.exr"));
}

TEST_F(Outputs, ADeviceNeedsNoSuffix) {
  const Outcome outcome = render_to("/dev/null");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  expect_failure("/dev/full", "No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Outputs, NeverReplaceAnInputOrEachOther) {
  ASSERT_EQ(render_to("map.exr").status, 0);
  const std::string mesh = folder_.read("square.obj"), map = folder_.read("map.exr");
  ASSERT_EQ(run_fathom({"camera", "orbit", "square.obj", "--views", "2", "-o", "path.json"},
                       {.folder = folder_.path()})
                .status,
            0);
  const std::vector<std::vector<std::string>> clashes = {
      {"render", "square.obj", "-o", "new.exr", "--save-camera", "./new.exr"},
      {"render", "square.obj", "-o", "new.exr", "--stats", "square.obj"},
      {"render", "square.obj", "--camera", "path.json", "-o", "{{index}}.exr"},
      {"render", "square.obj", "--camera", "path.json", "-o", "{index}.exr", "--stats",
       "path.json"},
      {"convert", "map.exr", "-o", "map.exr"},
      {"compare", "map.exr", "map.exr", "--json", "map.exr"},
      {"preview", "map.exr", "-o", "map.exr"},
  };
  const auto before = folder_.names();
  for (const auto& arguments : clashes) {
    const Outcome outcome = run_fathom(arguments, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 2) << arguments.back();
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(folder_.names(), before) << arguments.back();
  }
  EXPECT_EQ(folder_.read("square.obj"), mesh);
  EXPECT_EQ(folder_.read("map.exr"), map);
}

TEST_F(Outputs, WriteThroughANamedPipe) {
  ASSERT_EQ(::mkfifo((folder_ / "map.pfm").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = folder_.read("map.pfm"); });
  const Outcome outcome = render_to("map.pfm");
  reader.join();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::is_fifo(folder_ / "map.pfm"));
  ASSERT_EQ(render_to("file.pfm").status, 0);
  EXPECT_EQ(received, folder_.read("file.pfm"));
}

TEST_F(Outputs, APipeWhoseReaderLeavesIsAnError) {
  const Outcome outcome =
      run({"sh", "-c", "\"$0\" render square.obj --size 1000x1000 --stats - -o map.exr | true",
           program_path()},
          {.folder = folder_.path()});
  // The shell reports the status of `true`; what counts is that there is at most one line.
  EXPECT_LE(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(Outputs, FullDevice) {
  fs::create_symlink("/dev/full", folder_ / "map.exr");
  expect_failure("map.exr", "No space left on device");
}

TEST_F(Outputs, FullDisk) {
  const std::string disk = folder_ / "disk";
  fs::create_directory(disk);
  RunOptions options;
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=64k") == 0) {
    folder_.write("disk/map.exr", "older");
    std::ofstream(disk + "/filler") << std::string(48000, 'x');
  } else {
    // Without the right to mount, a limit on the size of files stands in for the disk.
    folder_.write("disk/map.exr", "older");
    options.file_size = 1000;
  }
  options.folder = folder_.path();
  const Outcome outcome = run_fathom(
      {"render", "square.obj", "--size", "400x300", "--compression", "none", "-o", "disk/map.exr"},
      options);
  const std::string map = folder_.read("disk/map.exr");
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(disk)) left.push_back(entry.path().filename());
  ::umount(disk.c_str());
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: disk/map.exr: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(map, "older");
  EXPECT_EQ(std::count_if(left.begin(), left.end(), [](const auto& n) { return n[0] == '.'; }), 0);
}

TEST_F(Outputs, BeyondTheLimitOfFileSizes) {
  folder_.write("map.npy", "older");
  expect_failure("map.npy", "", {.file_size = 100});
  EXPECT_EQ(folder_.read("map.npy"), "older");
}

TEST_F(Outputs, MissingFoldersAreMade) {
  const Outcome outcome = render_to("new/folder/./map.exr");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_GT(fs::file_size(folder_ / "new/folder/map.exr"), 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "new"), {}), 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "new/folder"), {}), 1);
}

TEST_F(Outputs, SeveralOutputsMayShareANewFolder) {
  const Outcome outcome = run_fathom({"render", "square.obj", "--save-camera", "new/a/camera.json",
                                      "--stats", "new/b/statistics.json", "-o", "new/a/map.exr"},
                                     {.folder = folder_.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"new/a/camera.json", "new/b/statistics.json", "new/a/map.exr"}) {
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  }
}

TEST_F(Outputs, ACommandThatFailsMakesNoFolder) {
  expect_failure("new/folder/map.exr", "", {.file_size = 100});
  EXPECT_NE(
      run_fathom({"render", "no.obj", "-o", "new/map.exr"}, {.folder = folder_.path()}).status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(Outputs, AFolderThatCannotBeMade) {
  fs::create_directory(folder_ / "locked");
  ::chmod((folder_ / "locked").c_str(), 0555);
  ::chmod(folder_.path().c_str(), 0755);
  expect_failure("locked/new/map.exr",
                 "cannot make the folder locked/new in locked: Permission denied",
                 {.as_nobody = true});
  fs::create_symlink("nowhere", folder_ / "link");
  expect_failure("link/map.exr", "");
}

TEST_F(Outputs, DirectoryAsOutput) {
  fs::create_directory(folder_ / "map.exr");
  expect_failure("map.exr", "directory");
}

TEST_F(Outputs, AFileAsDirectory) {
  expect_failure("square.obj/map.exr", "Not a directory");
}

TEST_F(Outputs, NameTooLong) {
  expect_failure(std::string(300, 'm') + ".exr", "too long");
}

TEST_F(Outputs, UnwritableDirectory) {
  fs::create_directory(folder_ / "locked");
  ::chmod((folder_ / "locked").c_str(), 0555);
  ::chmod(folder_.path().c_str(), 0755);
  expect_failure("locked/map.exr", "Permission denied", {.as_nobody = true});
}

TEST_F(Outputs, UnwritableFileIsNotReplaced) {
  folder_.write("map.exr", "older");
  ::chmod((folder_ / "map.exr").c_str(), 0444);
  ::chmod(folder_.path().c_str(), 0777);
  expect_failure("map.exr", "Permission denied", {.as_nobody = true});
  EXPECT_EQ(folder_.read("map.exr"), "older");
}

TEST_F(Outputs, OneThatFailsTakesTheOthersAlong) {
  folder_.write("map.exr", "older");
  const auto before = folder_.names();
  const Outcome outcome = run_fathom({"render", "square.obj", "-o", "map.exr", "--save-camera",
                                      "new.json", "--stats", "square.obj/stats.json"},
                                     {.folder = folder_.path()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: square.obj/stats.json: "));
  EXPECT_EQ(folder_.read("map.exr"), "older");
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Outputs, EveryCommandWritesBesideAndRenames) {
  ASSERT_EQ(render_to("map.exr").status, 0);
  const std::vector<std::vector<std::string>> commands{
      {"convert", "map.exr", "-o"},
      {"compare", "map.exr", "map.exr", "--json"},
      {"camera", "look-at", "--eye", "0,0,1", "-o"},
      {"camera", "orbit", "square.obj", "--views", "2", "-o"},
      {"render", "square.obj", "-o", "map.exr", "--stats"},
      {"render", "square.obj", "-o", "map.exr", "--save-camera"}};
  for (std::vector<std::string> command : commands) expect_kept(command, "output.pfm");
  expect_kept({"preview", "map.exr", "-o"}, "output.png");
  expect_kept({"compare", "map.exr", "map.exr", "--heatmap"}, "output.png");
}

}  // namespace
}  // namespace fathom::test
