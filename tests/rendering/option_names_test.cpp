#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/unknown_name.h"
#include "fathom/image/map_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/rendering/options.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;

template <class Values>
void expect_to_lead_back(const Values& values) {
  for (const auto value : values) EXPECT_EQ(value_named(values, name_of(value)), value);
  EXPECT_EQ(value_named(values, ""), std::nullopt);
  EXPECT_EQ(value_named(values, "None"), std::nullopt);
}

TEST(OptionNames, LeadToValuesAndBack) {
  expect_to_lead_back(all_engines);
  expect_to_lead_back(all_culls);
  expect_to_lead_back(all_normal_sources);
  expect_to_lead_back(all_stored_types);
  expect_to_lead_back(all_compressions);
  expect_to_lead_back(all_depth_quantities);
  expect_to_lead_back(all_point_frames);
}

TEST(OptionNames, AreThoseOfTheDocumentation) {
  EXPECT_THAT(names_of(all_engines), ElementsAre("fast", "reference"));
  EXPECT_THAT(names_of(all_culls), ElementsAre("back", "front", "none"));
  EXPECT_THAT(names_of(all_normal_sources), ElementsAre("file", "vertex", "place"));
  EXPECT_THAT(names_of(all_stored_types), ElementsAre("float32", "float64", "uint16"));
  EXPECT_THAT(names_of(all_compressions), ElementsAre("none", "rle", "zips", "zip", "piz"));
  EXPECT_THAT(names_of(all_depth_quantities), ElementsAre("Z", "distance", "disparity"));
  EXPECT_THAT(names_of(all_point_frames), ElementsAre("world", "camera"));
}

TEST(OptionNames, AreJoinedForMessages) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b"}), "a and b");
  EXPECT_EQ(joined({"a", "b", "c"}, " or "), "a, b or c");
}

}  // namespace
}  // namespace fathom
