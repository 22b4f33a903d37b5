#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

/// `fathom validate` with Blender: cameras that it does not have, and its process. A script stands
/// in for a Blender that hangs.
namespace fathom::test {
namespace {

using testing::HasSubstr;

TEST(ValidateBlender, CamerasThatBlenderCannotExpressAreRefused) {
  const Outcome outcome =
      run_fathom({"validate", "--against", "blender", "--scene", "calibrated", "--size", "32x24"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.out,
            "not drawn: blender: cannot express a camera with skew\n"
            "calibrated, blender cycles: blender: cannot express a camera with skew\n");
  EXPECT_EQ(outcome.err, "");
}

TEST(ValidateBlender, ARendererThatTakesTooLongIsEnded) {
  const TestFolder folder;
  folder.write("blender", "#!/bin/sh\nexec sleep 600\n");
  const std::string command =
      "chmod +x blender; PATH=$PWD:$PATH " + program_path() +
      " validate --against blender --scene sphere --size 32x24 --time-limit 1";
  const Outcome outcome = run({"/bin/sh", "-c", command}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("did not end within 1 seconds"));
}

// Blender, which here sleeps, and the folder of its files go with the program.
TEST(ValidateBlender, AnInterruptedRunLeavesNothingBehind) {
  const TestFolder folder;
  folder.write("blender",
               "#!/bin/sh\n[ \"$1\" = --version ] && exit\necho $$ >pid.part\n"
               "mv pid.part pid\nexec sleep 600\n");
  const std::string script =
      "chmod +x blender; mkdir tmp; export PATH=$PWD:$PATH TMPDIR=$PWD/tmp\n" + program_path() +
      " validate --against blender --scene sphere --size 32x24 &\n"
      "until [ -e pid ]; do sleep 0.05; done\n"
      "ls tmp; kill -TERM $!; wait $!; echo status $?\n"
      "until [ -z \"$(ls tmp)\" ] && ! kill -0 $(cat pid) 2>/dev/null; do sleep 0.05; done\n"
      "echo nothing left";
  const Outcome outcome =
      run({"timeout", "30", "/bin/sh", "-c", script}, {.folder = folder.path()});
  EXPECT_THAT(outcome.out, HasSubstr("fathom-validate-"));
  EXPECT_THAT(outcome.out, HasSubstr("status 130"));
  EXPECT_THAT(outcome.out, HasSubstr("nothing left"));
}

}  // namespace
}  // namespace fathom::test
