#include "fathom/clipping/weiler_atherton/nesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom::clipping {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Ring<Rational> square(int left, int low, int side) {
  return {{left, low}, {left + side, low}, {left + side, low + side}, {left, low + side}};
}

TEST(Nesting, DepthsCountTheRingsAround) {
  EXPECT_THAT(nesting_depths({}, "subject"), ElementsAre());
  EXPECT_THAT(nesting_depths({square(0, 0, 9)}, "subject"), ElementsAre(0));
  EXPECT_THAT(nesting_depths({square(2, 2, 2), square(0, 0, 9), square(1, 1, 5), square(6, 6, 2)},
                             "subject"),
              ElementsAre(2, 0, 1, 1));
  EXPECT_THAT(nesting_depths({square(0, 0, 1), square(5, 5, 1)}, "subject"), ElementsAre(0, 0));
}

TEST(Nesting, RingsMayTouchAndBeTheSame) {
  EXPECT_THAT(nesting_depths({square(0, 0, 2), square(2, 0, 2)}, "subject"), ElementsAre(0, 0));
  EXPECT_THAT(nesting_depths({square(0, 0, 4), square(0, 0, 2)}, "subject"), ElementsAre(0, 1));
  EXPECT_THAT(nesting_depths({square(0, 0, 4), square(0, 0, 4)}, "subject"), ElementsAre(0, 1));
}

TEST(Nesting, RingsThatCrossAreRefusedWithThePlace) {
  EXPECT_THAT(message_of<InputError>([] {
                nesting_depths({square(0, 0, 4), square(2, 2, 4)}, "clip");
              }),
              HasSubstr("clip rings"));
}

}  // namespace
}  // namespace fathom::clipping
