#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/convert.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/png_files.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"

/// PNGs as data sets have them: depths beyond the codes, what is said beside them, masks.
namespace fathom {
namespace {

using namespace image;
using ::testing::HasSubstr;
using namespace fathom::checks;

TEST(CodesBeyond, AreNoneAndCounted) {
  // 65535.5 is half way between two codes, and even is the one that does not exist.
  DepthMap map = map_of(6, 1, "Z", std::vector<float>{1, 65535, 65535.5f, 1e30f, inf, 65535.25f});
  const DepthMap codes = with_storage(map, "Z", StoredType::scaled_unorm16, 1.0, true);
  EXPECT_EQ(*codes.values<std::uint16_t>("Z"),
            (std::vector<std::uint16_t>{1, 65535, 0, 0, 0, 65535}));
  EXPECT_EQ(codes.codes_beyond, 2u);
  // A depth that overflowed is beyond too, where identifiers tell it from none.
  map.channels.push_back({"id", Samples<std::uint32_t>(6, 0)});
  EXPECT_EQ(with_storage(map, "Z", StoredType::scaled_unorm16, 1.0, true).codes_beyond, 3u);
}

TEST(CodesBeyond, DepthsThatAreTooNearOrNegativeStayErrors) {
  for (const float depth : {0.5f, 0.0f, -3.0f}) {
    DepthMap map = map_of(1, 1, "Z", std::vector<float>{depth});
    map.channels.push_back({"id", Samples<std::uint32_t>{0}});
    EXPECT_THROW(with_storage(map, "Z", StoredType::scaled_unorm16, 1.0, true), OutputError)
        << depth;
  }
}

TEST(CodesBeyond, AreInTheFileOnlyWhereTheyMayBe) {
  const DepthMap map = map_of(2, 1, "Z", std::vector<float>{1, 70});
  const DepthMap codes = with_storage(map, "Z", StoredType::scaled_unorm16, 1000.0, true);
  const DepthMap back = decode_map(encode_png(codes, codes.channels[0], "a.png"), "a.png");
  EXPECT_EQ(back.codes_beyond, 1u);
  EXPECT_EQ(back.texts.count("fathom:beyond"), 0u);
  // Depths of codes are no codes any more.
  EXPECT_EQ(with_storage(back, "Z", StoredType::binary32).codes_beyond, std::nullopt);
  const DepthMap strict = with_storage(map, "Z", StoredType::scaled_unorm16, 100.0);
  EXPECT_EQ(decode_map(encode_png(strict, strict.channels[0], "a.png"), "a.png").codes_beyond,
            std::nullopt);
}

TEST(CodesBeyond, OfAFileAreANumberOfItsPixels) {
  DepthMap codes = map_of(2, 1, "Z", std::vector<std::uint16_t>{1, 2});
  codes.png_scale = 1000;
  codes.codes_beyond = 3;
  try {
    decode_map(encode_png(codes, codes.channels[0], "a.png"), "a.png");
    FAIL() << "it was read";
  } catch (const InputError& failure) {
    EXPECT_STREQ(failure.what(), "a.png: its fathom:beyond is '3': expected a number of pixels");
  }
}

TEST(PngSidecar, SaysWhatCodesMean) {
  DepthMap map = map_of(2, 1, "Z", std::vector<std::uint16_t>{1, 0});
  map.png_scale = 1000.5;
  EXPECT_EQ(
      png_sidecar(map),
      "{\"channel\": \"Z\", \"unit\": \"codes per scene unit\", \"scale\": 1000.5, \"none\": 0, "
      "\"beyond\": 0, \"width\": 2, \"height\": 1}\n");
  map.codes_beyond = 1;
  EXPECT_THAT(png_sidecar(map, "Z"), HasSubstr("\"beyond\": 1"));
  map.channels.push_back({"id", Samples<std::uint32_t>{1, no_surface}});
  EXPECT_EQ(png_sidecar(map, "id"),
            "{\"channel\": \"id\", \"none\": 65535, \"width\": 2, \"height\": 1}\n");
  EXPECT_THROW(png_sidecar(map), UsageError);
  EXPECT_THROW(png_sidecar(map, "N"), UsageError);
}

TEST(MaskPicture, IsZeroAnd255AndAlwaysTheSameBytes) {
  const Folder folder;
  const std::vector<std::uint8_t> mask{0, 1, 2, 255, 0, 0};
  write_mask(mask, 3, 2, folder / "a.png");
  write_mask(mask, 3, 2, folder / "b.png");
  const files::InputFile a(folder / "a.png"), b(folder / "b.png");
  EXPECT_TRUE(std::ranges::equal(a.bytes(), b.bytes()));
  const Outcome outcome = run("cd '" + (folder / "").string() + R"(' && /usr/bin/python3 -c "
import cv2
import OpenImageIO as oiio
mask = cv2.imread('a.png', cv2.IMREAD_UNCHANGED)
print(mask.dtype, mask.tolist())
picture = oiio.ImageInput.open('a.png')
print(picture.spec().nchannels, picture.read_image('uint8')[:, :, 0].tolist())
")");
  EXPECT_EQ(outcome.output, "uint8 [[0, 255, 255], [255, 0, 0]]\n1 [[0, 255, 255], [255, 0, 0]]\n");
}

TEST(MaskPicture, OfAnotherSizeIsRefused) {
  const Folder folder;
  const std::vector<std::uint8_t> mask(6);
  EXPECT_THROW(write_mask(mask, 3, 3, folder / "a.png"), InputError);
  EXPECT_THROW(write_mask({}, 0, 3, folder / "a.png"), InputError);
  EXPECT_THROW(write_mask(mask, 3, 2, "/nowhere/a.png"), OutputError);
}

TEST(Codes, OpenCvAndGdalReadThem) {
  const Folder folder;
  DepthMap map = map_of(3, 1, "Z", std::vector<std::uint16_t>{1, 0, 65535});
  map.png_scale = 1000;
  write_map(map, folder / "map.png", MapFormat::png);
  const Outcome outcome = run("cd '" + (folder / "").string() + R"(' && /usr/bin/python3 -c "
import cv2
from osgeo import gdal
gdal.UseExceptions()
print(cv2.imread('map.png', cv2.IMREAD_UNCHANGED).tolist())
print(gdal.Open('map.png').ReadAsArray().tolist())
")");
  EXPECT_EQ(outcome.output, "[[1, 0, 65535]]\n[[1, 0, 65535]]\n");
}

}  // namespace
}  // namespace fathom
