// What a file may name: regular files, and with a boundary only those below its folder.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace files;
using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// A folder "inside" beside a file "outside.txt".
struct TwoPlaces {
  ScratchFolder folder;
  std::filesystem::path inside = folder.path() / "inside";
  std::vector<Boundary> boundary{{inside, "as this test wants"}};

  TwoPlaces() {
    std::filesystem::create_directory(inside);
    folder.write("outside.txt", "secret");
    folder.write("inside/own.txt", "own");
  }
  [[nodiscard]] std::string read(const std::filesystem::path& path) const {
    return std::string(InputFile(path, boundary).text());
  }
  [[nodiscard]] std::string refusal(const std::filesystem::path& path) const {
    return message_of<InputError>([&] { static_cast<void>(read(path)); });
  }
};

TEST(Confinement, FilesBelowTheFolderAreTheirBytes) {
  const TwoPlaces places;
  std::filesystem::create_directory(places.inside / "deeper");
  places.folder.write("inside/deeper/a", "a");
  EXPECT_EQ(places.read(places.inside / "own.txt"), "own");
  EXPECT_EQ(places.read(places.inside / "deeper/a"), "a");
  EXPECT_EQ(places.read(places.inside / "deeper/../own.txt"), "own");
}

TEST(Confinement, PathsThatLeaveTheFolderAreRefused) {
  const TwoPlaces places;
  const std::string refusal = places.refusal(places.inside / "../outside.txt");
  EXPECT_EQ(refusal, (places.inside / "../outside.txt").string() + ": lies outside " +
                         places.inside.string() + ", as this test wants");
  EXPECT_THAT(places.refusal("/etc/passwd"), HasSubstr("lies outside"));
}

/// A folder whose name merely begins as the boundary's does is another folder.
TEST(Confinement, NeighboursWhoseNamesBeginAlikeAreOutside) {
  const TwoPlaces places;
  std::filesystem::create_directory(places.folder.path() / "inside-too");
  places.folder.write("inside-too/a", "a");
  EXPECT_THAT(places.refusal(places.folder.path() / "inside-too/a"), HasSubstr("lies outside"));
}

TEST(Confinement, SymbolicLinksCountWhereTheyLead) {
  const TwoPlaces places;
  std::filesystem::create_symlink("../outside.txt", places.inside / "out");
  std::filesystem::create_symlink("own.txt", places.inside / "in");
  std::filesystem::create_directory_symlink("..", places.inside / "up");
  EXPECT_THAT(places.refusal(places.inside / "out"), HasSubstr("lies outside"));
  EXPECT_THAT(places.refusal(places.inside / "up/outside.txt"), HasSubstr("lies outside"));
  EXPECT_EQ(places.read(places.inside / "in"), "own");
  // A boundary may be a link itself, and be left by one that leads back.
  std::filesystem::create_directory_symlink("inside", places.folder.path() / "link");
  const std::vector<Boundary> link{{places.folder.path() / "link", ""}};
  EXPECT_EQ(InputFile(places.inside / "up/link/own.txt", link).text(), "own");
}

TEST(Confinement, EveryBoundaryHolds) {
  const TwoPlaces places;
  const std::vector<Boundary> both{{places.folder.path(), "the outer"},
                                   {places.inside, "the inner"}};
  EXPECT_EQ(InputFile(places.inside / "own.txt", both).text(), "own");
  EXPECT_THAT(
      message_of<InputError>([&] { InputFile file(places.folder.path() / "outside.txt", both); }),
      EndsWith("the inner"));
}

TEST(Confinement, AnEmptyFolderIsTheWorkingDirectory) {
  const TwoPlaces places;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(places.inside);
  const std::vector<Boundary> here{{"", "as this test wants"}};
  EXPECT_EQ(InputFile("own.txt", here).text(), "own");
  EXPECT_EQ(message_of<InputError>([&] { InputFile file("../outside.txt", here); }),
            "../outside.txt: lies outside ., as this test wants");
  std::filesystem::current_path(before);
}

/// Between a look at where a link leads and its opening.
TEST(Confinement, LinksThatAreExchangedMeanwhileLeadNowhereElse) {
  const TwoPlaces places;
  const auto link = places.inside / "link", other = places.inside / "other";
  std::filesystem::create_symlink("own.txt", link);
  std::filesystem::create_symlink("../outside.txt", other);
  const std::jthread exchanging([&](const std::stop_token& stop) {
    while (!stop.stop_requested())
      ::renameat2(AT_FDCWD, link.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE);
  });
  for (int i = 0; i < 3000; ++i) {
    try {
      ASSERT_EQ(places.read(link), "own");
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), AnyOf(HasSubstr("lies outside"), HasSubstr("was exchanged")));
    }
  }
}

/// Opening a pipe to find out what it is would wait for its writer, without end.
TEST(Confinement, PipesAndDevicesAreRefusedUnopened) {
  const TwoPlaces places;
  const auto pipe = places.inside / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(places.refusal(pipe), HasSubstr("is not a regular file"));
  for (const char* device : {"/dev/zero", "/dev/stdin", "/dev/tty"}) {
    if (!std::filesystem::exists(device)) continue;
    EXPECT_THAT(message_of<InputError>([&] { InputFile file(device, std::vector<Boundary>()); }),
                HasSubstr("is not a regular file"))
        << device;
  }
  EXPECT_THAT(places.refusal(places.inside), HasSubstr("outside"));
  EXPECT_THAT(
      message_of<InputError>([&] { InputFile file(places.inside, std::vector<Boundary>()); }),
      HasSubstr("is a directory"));
}

TEST(Confinement, NamesWhatIsMissing) {
  const TwoPlaces places;
  EXPECT_THAT(places.refusal(places.inside / "none"), HasSubstr("none: cannot be opened: "));
  const std::vector<Boundary> missing{{places.folder.path() / "no-folder", ""}};
  EXPECT_THAT(message_of<InputError>([&] { InputFile file(places.inside / "own.txt", missing); }),
              HasSubstr("no-folder: cannot be opened: "));
}

/// The name "-" means standard input only where a user gives it.
TEST(Confinement, AMinusIsAnOrdinaryName) {
  EXPECT_THAT(message_of<InputError>([] { InputFile file("-", std::vector<Boundary>()); }),
              HasSubstr("-: cannot be opened: No such file"));
}

}  // namespace
}  // namespace fathom
