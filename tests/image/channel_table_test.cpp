#include "fathom/image/channel_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace fathom {
namespace {

using ::testing::ElementsAre;

TEST(ChannelTable, NamesLeadToChannelsAndBack) {
  std::set<std::string> names;
  for (const ChannelDescription& d : channel_table) {
    EXPECT_EQ(channel_named(d.name), d.channel);
    EXPECT_EQ(&description_of(d.channel), &d);
    for (const std::string& name : part_names(d.channel)) {
      EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
  EXPECT_EQ(names.size(), 17U - 5 + 4 * 3 + 2);
  EXPECT_EQ(channel_named("z"), std::nullopt);
  EXPECT_EQ(channel_named("N.X"), std::nullopt);
  EXPECT_EQ(channel_named(""), std::nullopt);
}

TEST(ChannelTable, PartsAndWordsForPeople) {
  EXPECT_THAT(part_names(Channel::Z), ElementsAre("Z"));
  EXPECT_THAT(part_names(Channel::N), ElementsAre("N.X", "N.Y", "N.Z"));
  EXPECT_THAT(part_names(Channel::bary), ElementsAre("bary.U", "bary.V"));
  EXPECT_EQ(channel_names(),
            "Z, A, Zlow, distance, id, face, object, material, group, part, label, N, P, bary, Nc, "
            "Ns and valid");
}

TEST(ChannelTable, IdentifiersThatShowSegments) {
  std::vector<std::string_view> names;
  for (const ChannelDescription& d : channel_table)
    if (shows_segments(d.name)) names.push_back(d.name);
  EXPECT_THAT(names, ElementsAre("material", "group", "part", "label"));
}

}  // namespace
}  // namespace fathom
