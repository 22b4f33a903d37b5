#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/validation/validate/validate_runs.h"

/// `fathom validate` with Embree as it is installed (FATHOM_PEERS).
namespace fathom::test {
namespace {

using testing::HasSubstr;

TEST(ValidateEmbree, EveryVariantIsExplained) {
  const auto results = results_of("embree", "sphere,orthographic");
  EXPECT_EQ(results.size(), 2U * 2);
  for (const auto& result : results) expect_explained(result);
}

TEST(ValidateEmbree, WhatCannotBeWrittenIsSaidBeforeAnythingIsDrawn) {
  const TestFolder folder;
  folder.write("file", "");
  const Outcome outcome =
      run_fathom({"validate", "--against", "embree", "--scene", "sphere", "--out", "file"},
                 {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("file: cannot make this folder"));
}

}  // namespace
}  // namespace fathom::test
