#include "fathom/failures/unknown_name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fathom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<std::string> names{"near", "far", "c", "cw", "ccw", "channels", "channel", "Z"};

TEST(UnknownName, NearestAreThoseWithTheFewestWrongLetters) {
  EXPECT_THAT(nearest_names("naer", names), ElementsAre("near"));         // exchanged
  EXPECT_THAT(nearest_names("fa", names), ElementsAre("far"));            // missing
  EXPECT_THAT(nearest_names("fear", names), ElementsAre("near", "far"));  // wrong; too many
  EXPECT_THAT(nearest_names("chanels", names), ElementsAre("channels"));  // one, not two as channel
  EXPECT_THAT(nearest_names("chanel", names), ElementsAre("channel"));    // not channels
  EXPECT_THAT(nearest_names("shanneks", names), ElementsAre("channels"));  // two of eight
  EXPECT_THAT(nearest_names("CHANNEL", names), ElementsAre("channel"));    // upper and lower case
}

TEST(UnknownName, BeginningsAreCompleted) {
  EXPECT_EQ(suggestion("chan", names), "; did you mean 'channels' or 'channel'?");
  EXPECT_EQ(suggestion("CHA", names), "; did you mean 'channels' or 'channel'?");
  EXPECT_EQ(suggestion("ch", {"channels"}), "");  // too short
  EXPECT_EQ(suggestion("red", {"redder", "reds"}), "; did you mean 'reds'?");
  EXPECT_EQ(suggestion("red", {"redder", "reddest", "redness", "reddish"}), "");
  EXPECT_STREQ(UnknownName("no 'cha'; is it 'Z'?", "cha", names).what(), "no 'cha'; is it 'Z'?");
}

TEST(UnknownName, WhatIsFarFromAllIsLikeNone) {
  EXPECT_THAT(nearest_names("naerr", names), IsEmpty());  // two of four
  EXPECT_THAT(nearest_names("b", names), IsEmpty());      // nothing of "c" would remain
  EXPECT_THAT(nearest_names("", names), IsEmpty());
  EXPECT_THAT(nearest_names("depth", names), IsEmpty());
  EXPECT_THAT(nearest_names("near", {}), IsEmpty());
}

TEST(UnknownName, NamesOfOtherProgramsAreAskedBack) {
  constexpr OtherName others[] = {{"depth", "Z"}, {"farplane", "far"}, {"shade", "colour"}};
  const auto text = [&](const std::string& name) {
    return std::string(unknown_name("no", name, names, others).what());
  };
  EXPECT_EQ(text("depth"), "no; did you mean 'Z'?");
  EXPECT_EQ(text("GL_Far_Plane"), "no; did you mean 'far'?");
  EXPECT_EQ(text("fa"), "no; did you mean 'far'?");  // once
  EXPECT_EQ(text("shade"), "no");                    // there is no colour here
}

TEST(UnknownName, TheErrorAsksAndCarriesTheNames) {
  const UnknownName one("'naer' is none", "naer", names);
  EXPECT_STREQ(one.what(), "'naer' is none; did you mean 'near'?");
  EXPECT_EQ(one.name(), "naer");
  EXPECT_EQ(one.names(), names);
  EXPECT_STREQ(UnknownName("no", "fear", names).what(), "no; did you mean 'near' or 'far'?");
  EXPECT_STREQ(UnknownName("no", "depth", names).what(), "no");
}

}  // namespace
}  // namespace fathom
