#include <gtest/gtest.h>

#include "fathom/attribution/model/named_models.h"

namespace fathom::attribution {
namespace {

RasterModel raster_with(const std::string& version, std::uint32_t size) {
  RendererModel model{.kind = RasterModel{}};
  set_driver_facts(version, 4, {.width = size, .height = size / 2}, model);
  EXPECT_EQ(model.watertight, version.find("softpipe") == std::string::npos);
  return std::get<RasterModel>(model.kind);
}

TEST(DriverFacts, OfADriverThatIsNotKnownNothingIsAssumed) {
  const RasterModel model = raster_with("Mesa, V3D 4.2, 3.1", 320);
  EXPECT_FALSE(model.depth_before_snap);
  EXPECT_FALSE(model.nearest_codes);
  EXPECT_EQ(model.subpixel_bits, 4);
}

TEST(DriverFacts, LlvmpipeSnapsAndRounds) {
  const RasterModel model = raster_with("Mesa, llvmpipe (LLVM 15.0.6, 256 bits), 4.5", 320);
  EXPECT_TRUE(model.depth_before_snap);
  EXPECT_TRUE(model.nearest_codes);
  EXPECT_EQ(model.subpixel_bits, 4);
}

// 12u·321 is 2^−12.1, which snapping to 2^−11 covers; eight times the size takes three bits.
TEST(DriverFacts, SoftpipesRoundingsGrowWithTheImage) {
  const RasterModel model = raster_with("Mesa, softpipe, 3.3", 320);
  EXPECT_FALSE(model.nearest_codes);
  EXPECT_EQ(model.subpixel_bits, 11);
  EXPECT_EQ(raster_with("Mesa, softpipe, 3.3", 2560).subpixel_bits, 8);
}

}  // namespace
}  // namespace fathom::attribution
