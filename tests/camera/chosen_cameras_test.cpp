// Which of the imported cameras are taken, and what is said of the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

ImportedCamera named(const char* name) {
  ImportedCamera one;
  one.camera.width = one.camera.height = 4;
  one.camera.name = name;
  return one;
}

ImportedCamera distorted(const char* name) {
  ImportedCamera one = named(name);
  one.distortion = std::string(name) + " has lens distortion";
  return one;
}

ImportedCamera absent(const char* name) {
  ImportedCamera one = named(name);
  one.absence = std::string(name) + " was not tracked";
  return one;
}

ImportedCamera broken(const char* name) {
  ImportedCamera one = named(name);
  one.fault = std::string(name) + " is singular";
  return one;
}

std::vector<std::string> names(const std::vector<Camera>& cameras) {
  std::vector<std::string> result;
  for (const Camera& camera : cameras) result.push_back(camera.name);
  return result;
}

TEST(ChosenCameras, AllOfThemInTheirOrder) {
  Warnings warnings;
  EXPECT_THAT(names(chosen_cameras({named("b"), named("a")}, "in", {}, warnings)),
              ElementsAre("b", "a"));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(ChosenCameras, DistortedOnesAreLeftOutAndCounted) {
  Warnings warnings;
  const std::vector<ImportedCamera> some{named("a"), distorted("b"), named("c"), distorted("d")};
  EXPECT_THAT(names(chosen_cameras(some, "in", {}, warnings)), ElementsAre("a", "c"));
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("2 of 4 cameras have lens distortion and are"),
                                          HasSubstr("b has lens distortion; undistort"),
                                          HasSubstr("--ignore-distortion"))));
  warnings.clear();
  EXPECT_THAT(names(chosen_cameras(some, "in", {.ignore_distortion = true}, warnings)),
              ElementsAre("a", "b", "c", "d"));
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_THAT(message_of<InputError>([&] {
                chosen_cameras({distorted("a"), distorted("b")}, "in", {}, warnings);
              }),
              AllOf(HasSubstr("a has lens distortion"), HasSubstr("--ignore-distortion")));
}

TEST(ChosenCameras, AbsentOnesAreLeftOutAndCounted) {
  Warnings warnings;
  EXPECT_THAT(names(chosen_cameras({absent("a"), named("b")}, "in", {}, warnings)),
              ElementsAre("b"));
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("1 of 2 cameras is left out"),
                                          HasSubstr("a was not tracked"))));
  EXPECT_EQ(message_of<InputError>([&] { chosen_cameras({absent("a")}, "in", {}, warnings); }),
            "a was not tracked");
}

TEST(ChosenCameras, OnlyTheOneThatIsAskedForIsJudged) {
  Warnings warnings;
  const std::vector<ImportedCamera> some{broken("a"), distorted("b"), absent("c"), named("d")};
  EXPECT_THAT(names(chosen_cameras(some, "in", {.image = "d"}, warnings)), ElementsAre("d"));
  EXPECT_THAT(
      names(chosen_cameras(some, "in", {.image = "b", .ignore_distortion = true}, warnings)),
      ElementsAre("b"));
  EXPECT_THAT(warnings, IsEmpty());
  const auto fault = [&](const char* image) {
    return message_of<InputError>([&] { chosen_cameras(some, "in", {.image = image}, warnings); });
  };
  EXPECT_EQ(fault("a"), "a is singular");
  EXPECT_THAT(fault("b"), AllOf(HasSubstr("b has lens distortion; "), HasSubstr("undistort")));
  EXPECT_EQ(fault("c"), "c was not tracked");
  EXPECT_EQ(fault("x\n"), "in: no image 'x?'; --list shows the 4 there are");
  EXPECT_THAT(message_of<InputError>([&] { chosen_cameras(some, "in", {}, warnings); }),
              AllOf(HasSubstr("a is singular"), Not(HasSubstr("\n"))));
  EXPECT_EQ(message_of<InputError>([&] { chosen_cameras({}, "in", {}, warnings); }),
            "in: holds no camera");
}

}  // namespace
}  // namespace fathom
