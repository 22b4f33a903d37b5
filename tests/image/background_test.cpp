#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/image/compare.h"
#include "fathom/image/convert.h"
#include "fathom/image/map_files.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;
using namespace fathom::checks;

/// A surface, background, a depth that overflowed, told by `id`; and what is no depth.
DepthMap with_overflow() {
  DepthMap map = map_of(3, 1, "Z", std::vector<float>{2, inf, inf});
  map.channels.push_back({"id", std::vector<std::uint32_t>{7, no_surface, 8}});
  map.channels.push_back({"distance", std::vector<double>{3, INFINITY, INFINITY}});
  map.channels.push_back({"Zlow", std::vector<float>{0.5f, 0, 0}});
  return map;
}

TEST(Background, IsWrittenInEveryDepthChannelAndNoOther) {
  const DepthMap zero = with_background(with_overflow(), 0);
  EXPECT_THAT(*zero.values<float>("Z"), ElementsAre(2, 0, inf));
  EXPECT_THAT(*zero.values<double>("distance"), ElementsAre(3, 0, INFINITY));
  EXPECT_THAT(*zero.values<float>("Zlow"), ElementsAre(0.5f, 0, 0));
  EXPECT_THAT(*zero.values<std::uint32_t>("id"), ElementsAre(7, no_surface, 8));
  EXPECT_EQ(zero.texts.at("fathom.background"), "0");
  const DepthMap none = with_background(with_overflow(), nan);
  EXPECT_THAT(*none.values<float>("Z"), ElementsAre(2, IsNan(), inf));
  EXPECT_EQ(none.texts.at("fathom.background"), "nan");
}

TEST(Background, IsWhatTheMapSaysAndThatAlone) {
  for (const double value : {0.0, nan, -1.0, 0.1, 1e10}) {
    DepthMap map = with_background(with_overflow(), value);
    // Without identifiers, what overflowed still shows a surface.
    map.channels.erase(map.channels.begin() + 1);
    EXPECT_THAT(surface_mask(map, map.channels[0]), ElementsAre(1, 0, 1)) << value;
    EXPECT_THAT(surface_mask(map, map.channels[1]), ElementsAre(1, 0, 1)) << value;
    EXPECT_THAT(surface_mask(map, map.channels[2]), ElementsAre(1, 0, 1)) << value;
  }
  DepthMap map = with_overflow();
  map.channels.erase(map.channels.begin() + 1);
  EXPECT_THAT(surface_mask(map, map.channels[0]), ElementsAre(1, 0, 0));
  EXPECT_THAT(surface_mask(with_background(map, 0), map.channels[0]), ElementsAre(1, 1, 1))
      << "the channel still has +∞, which a background of 0 makes a depth";
}

TEST(Background, ChangesToAnyOtherAndBackWithoutATrace) {
  const DepthMap map = with_overflow();
  DepthMap changed = map;
  for (const double value : {0.0, nan, -1.0, 0.1, std::numeric_limits<double>::infinity()})
    changed = with_background(changed, value);
  for (std::size_t c = 0; c < map.channels.size(); ++c)
    EXPECT_EQ(bits_of(changed.channels[c]), bits_of(map.channels[c]));
  EXPECT_EQ(changed.texts, map.texts);
}

TEST(Background, MapsOfAnyBackgroundCompareEqual) {
  const DepthMap map = with_overflow();
  for (const double value : {0.0, nan, -1.0, 1e10}) {
    DepthMap other = with_background(map, value);
    other.channels.resize(1);  // no identifiers to help
    EXPECT_EQ(compare_maps(map, other).channels.at(0).both, 1u + 0u) << value;
    EXPECT_EQ(compare_maps(other, other).channels.at(0).bit_equal, 2u) << value;
    EXPECT_TRUE(compare_maps(other, other).channels.at(0).notes.empty()) << "nothing is guessed";
  }
}

std::string refusal_of(const DepthMap& map, double value) {
  try {
    with_background(map, value);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Background, ThatIsKnownIsNotGuessed) {
  // A depth that has underflowed, and no background in the picture: 0 would be taken for it.
  const DepthMap map = map_of(2, 1, "Z", std::vector<float>{0, 3});
  EXPECT_THAT(*with_background(map, -1).values<float>("Z"), ElementsAre(-1, 3));
  EXPECT_THAT(*with_background(map, -1, INFINITY).values<float>("Z"), ElementsAre(0, 3));
  EXPECT_THROW(with_background(map, 0, INFINITY), OutputError);
  DepthMap says = map;
  says.texts["fathom.background"] = "inf";
  EXPECT_THAT(surface_mask(says, says.channels[0]), ElementsAre(1, 1));
}

TEST(Background, NoSurfaceMayHaveIt) {
  const DepthMap map = map_of(2, 2, "Z", std::vector<float>{1, inf, 0.1f, 3});
  EXPECT_THAT(refusal_of(map, 0.1), HasSubstr("pixel (0, 1): a surface has the value 0.1"));
  EXPECT_THROW(with_background(map, 0.1), OutputError);
  EXPECT_EQ(refusal_of(map, 0.125), "");
  EXPECT_THROW(with_background(map, 1e300), UsageError);
  EXPECT_THROW(with_background(map, -INFINITY), UsageError);
  const DepthMap codes = map_of(1, 1, "Z", std::vector<std::uint16_t>{0});
  EXPECT_THROW(with_background(codes, 0), UsageError);
}

TEST(Background, IsRefusedWhereItIsNoNumber) {
  for (const char* text : {"", "zero", "1 ", "infinity", "-inf", "1e999", "nan(3)"}) {
    DepthMap map = with_overflow();
    map.texts["fathom.background"] = text;
    EXPECT_THROW(declared_background(map), InputError) << text;
    map.channels.erase(map.channels.begin() + 1);
    EXPECT_THROW(surface_mask(map, map.channels[0]), InputError) << text;
  }
}

TEST(Background, IsReadBackFromFiles) {
  const Folder folder;
  for (const double value : {0.0, nan, -1.0, 0.1}) {
    DepthMap map = with_background(with_overflow(), value);
    map.channels.erase(map.channels.begin() + 1);
    write_map(map, folder / "map.npz", MapFormat::npz);
    map.channels.erase(map.channels.begin() + 1);
    write_map(map, folder / "map.exr", MapFormat::exr);
    for (const char* name : {"map.exr", "map.npz"}) {
      const DepthMap back = read_map(folder / name);
      EXPECT_THAT(surface_mask(back, *back.find("Z")), ElementsAre(1, 0, 1)) << name << value;
    }
  }
  DepthMap wrong = with_overflow();
  wrong.texts["fathom.background"] = "far";
  wrong.channels.resize(1);
  write_map(wrong, folder / "wrong.exr", MapFormat::exr);
  try {
    read_map(folder / "wrong.exr");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("wrong.exr: its fathom.background is 'far'"));
  }
}

TEST(Background, ConversionsKnowIt) {
  Camera camera{.width = 3, .height = 1, .projection = {.fx = 100, .fy = 100}};
  const StereoRig rig{0.5, 0};
  const DepthMap map = with_background(map_of(2, 1, "Z", std::vector<float>{10, inf}), -1);
  const auto convert = [&](DepthQuantity from, DepthQuantity to, const DepthMap& source) {
    return convert_quantity(source, from, to, camera, rig);
  };
  using enum DepthQuantity;
  const DepthMap distance = convert(planar_depth, ray_distance, map);
  EXPECT_EQ(distance.values<float>("distance")->at(1), -1);
  EXPECT_EQ(distance.texts.at("fathom.background"), "-1");
  const DepthMap near = convert(planar_depth, DepthQuantity::disparity, map);
  EXPECT_THAT(*near.values<float>("disparity"), ElementsAre(5, 0));
  const DepthMap depth = convert(DepthQuantity::disparity, planar_depth, near);
  EXPECT_THAT(*depth.values<float>("Z"), ElementsAre(10, inf));
  // Codes have a background of their own, before and after.
  const DepthMap codes = with_storage(map, "Z", StoredType::scaled_unorm16, 100);
  EXPECT_THAT(*codes.values<std::uint16_t>("Z"), ElementsAre(1000, 0));
  EXPECT_TRUE(codes.texts.empty());
  EXPECT_THAT(*with_storage(codes, "Z", StoredType::binary32).values<float>("Z"),
              ElementsAre(10, inf));
}

TEST(Background, OfDisparitiesWithAnOffsetMayBeAmbiguous) {
  Camera camera{.width = 3, .height = 1, .projection = {.fx = 100, .fy = 100}};
  // The first is so far away that its disparity, 50/12.5 − 4, is 0.
  const DepthMap map = map_of(3, 1, "Z", std::vector<float>{12.5f, inf, 25});
  const auto convert = [&](std::optional<double> background) {
    return convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::disparity, camera,
                            StereoRig{0.5, 4}, background);
  };
  EXPECT_THROW(convert({}), OutputError);
  EXPECT_THAT(*convert(INFINITY).values<float>("disparity"), ElementsAre(0, inf, -2));
  // A disparity below 0 is one, and no background.
  const DepthMap foreign = map_of(3, 1, "disparity", std::vector<float>{0, -2, 1});
  EXPECT_THAT(surface_mask(foreign, foreign.channels[0]), ElementsAre(0, 1, 1));
}

}  // namespace
}  // namespace fathom
