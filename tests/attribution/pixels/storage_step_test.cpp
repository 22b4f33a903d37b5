#include <gtest/gtest.h>

#include "fathom/attribution/pixels/stored_values.h"

namespace fathom::attribution {
namespace {

TEST(StorageStep, IsTheDistanceOfNeighbours) {
  EXPECT_EQ(binary32_spacing(1), 0x1p-23);
  EXPECT_EQ(binary32_spacing(0.75), 0x1p-24);
  EXPECT_EQ(binary32_spacing(-3), 0x1p-22);
  EXPECT_EQ(binary32_spacing(0), 0x1p-149);
  EXPECT_EQ(binary32_spacing(0x1p-140), 0x1p-149);

  const auto step = [](Mapping mapping, Storage storage, double window) {
    return storage_step({.mapping = mapping, .storage = storage}, window);
  };
  EXPECT_EQ(step(Mapping::opengl, Storage::unorm16, 0.75), 1 / 65535.0);
  EXPECT_EQ(step(Mapping::reversed, Storage::unorm24, 0.01), 1 / 16777215.0);
  EXPECT_EQ(step(Mapping::reversed, Storage::float32, 0.01), binary32_spacing(0.01));
  EXPECT_EQ(step(Mapping::reversed, Storage::float16, 0.75), 0x1p-11);
}

// z_ndc/2 + 1/2 is computed among numbers of about a half, whatever is near.
TEST(StorageStep, IsNoFinerThanTheArithmetic) {
  const RasterModel model{.mapping = Mapping::opengl, .storage = Storage::float32};
  EXPECT_EQ(storage_step(model, 0.01), 0x1p-24);
  RasterModel written{.storage = Storage::float32};
  written.written = written_depth(ProjectionModel::perspective, Mapping::log_ulrich, 0.5, 20);
  EXPECT_GT(storage_step(written, 0.75), 0x1p-24);
}

}  // namespace
}  // namespace fathom::attribution
