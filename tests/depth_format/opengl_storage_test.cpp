#include <gtest/gtest.h>

#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"

namespace fathom {
namespace {

TEST(OpenGlStorage, OfAttachments) {
  EXPECT_EQ(storage_of_attachment(16, false), Storage::unorm16);
  EXPECT_EQ(storage_of_attachment(24, false), Storage::unorm24);
  EXPECT_EQ(storage_of_attachment(32, false), Storage::unorm32);
  EXPECT_EQ(storage_of_attachment(32, true), Storage::float32);
  EXPECT_THROW(storage_of_attachment(0, false), InputError);
  EXPECT_THROW(storage_of_attachment(16, true), InputError);
}

TEST(OpenGlStorage, CodesGoFrom0To1) {
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm16, 65535), 1);
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm24, 0xFFFFFF00), 1);
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm32, 0xFFFFFFFF), 1);
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm16, 1), 1 / 65535.0);
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm24, 0x1FF), 1 / 16777215.0);
  EXPECT_EQ(window_depth_of_pixel(Storage::unorm32, 1), 1 / 4294967295.0);
}

}  // namespace
}  // namespace fathom
