// Which files a run reads and writes, also where other processes replace them meanwhile.
#include "apps/shell/known_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class KnownFiles : public ::testing::Test {
 protected:
  /// Another process writes a new file at `known`, and the system gives the number of the file that
  /// was there to one at `other`. A link stands for the second: a file system that uses numbers
  /// again does so when it likes.
  void replace_and_use_number_again(const fs::path& known, const fs::path& other) const {
    fs::create_hard_link(known, other);
    fs::rename(folder_.write("replacement", "new"), known);
  }

  ScratchFolder folder_;
};

TEST_F(KnownFiles, ANumberThatIsUsedAgainIsNoSecondOutput) {
  const fs::path first = folder_.write("transforms.json", "old");
  const fs::path second = folder_.path() / "cameras.json";
  claim_output(first, first);
  replace_and_use_number_again(first, second);
  EXPECT_NO_THROW(claim_output(second, second));
}

TEST_F(KnownFiles, ANumberThatIsUsedAgainIsNoInput) {
  const fs::path mesh = folder_.write("mesh.obj", "old");
  const fs::path output = folder_.path() / "map.exr";
  note_input(mesh);
  replace_and_use_number_again(mesh, output);
  EXPECT_NO_THROW(claim_output(output, output));
}

TEST_F(KnownFiles, ANumberWhoseFileIsGoneIsNoInput) {
  const fs::path mesh = folder_.write("mesh.obj", "old");
  const fs::path output = folder_.path() / "map.exr";
  note_input(mesh);
  fs::rename(mesh, output);
  EXPECT_NO_THROW(claim_output(output, output));
}

TEST_F(KnownFiles, LinksToOneFileAreOneFile) {
  const fs::path mesh = folder_.write("mesh.obj", "mesh"), old = folder_.write("old", "map");
  fs::create_hard_link(mesh, folder_.path() / "hard.obj");
  fs::create_symlink(mesh, folder_.path() / "soft.obj");
  fs::create_hard_link(old, folder_.path() / "again");
  note_input(mesh);
  claim_output(old, old);
  const auto refusal = [&](const char* name) {
    return message_of<UsageError>(
        [&] { claim_output(folder_.path() / name, folder_.path() / name); });
  };
  EXPECT_THAT(refusal("hard.obj"), HasSubstr("hard.obj: is an input of this command"));
  EXPECT_THAT(refusal("soft.obj"), HasSubstr("soft.obj: is an input of this command"));
  EXPECT_THAT(refusal("again"), HasSubstr("again: would be written twice"));
  EXPECT_THAT(refusal("old"), HasSubstr("old: would be written twice"));
}

/// A new output has no number yet: it is known by its place, however that is written.
TEST_F(KnownFiles, NewOutputsAreKnownByTheirPlaces) {
  const fs::path place = folder_.path() / "new.exr", same = folder_.path() / "." / "new.exr";
  claim_output(place, place);
  EXPECT_THROW(claim_output(same, same), UsageError);
}

}  // namespace
}  // namespace fathom::app
