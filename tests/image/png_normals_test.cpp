#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/map_files.h"
#include "fathom/image/png_files.h"
#include "fathom/numeric/rounding.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"
#include "tests/scratch_folder.h"

/// Normals as the colours of a PNG, and masks of maps.
namespace fathom {
namespace {

using namespace image;
using namespace fathom::checks;
using ::testing::HasSubstr;

DepthMap normals(const std::string& channel, const std::vector<std::array<float, 3>>& pixels) {
  DepthMap map;
  map.width = static_cast<std::uint32_t>(pixels.size());
  map.height = 1;
  for (std::size_t part = 0; part < 3; ++part) {
    Samples<float> values(pixels.size());
    for (std::size_t k = 0; k < pixels.size(); ++k) values[k] = pixels[k][part];
    map.channels.push_back({channel + "." + "XYZ"[part], std::move(values)});
  }
  return map;
}

TEST(NormalCodes, AreTheExactNumberRoundedOnce) {
  for (const int bits : {8, 16}) {
    const Ratio greatest(Dyadic(bits == 8 ? 255.0 : 65535.0));
    std::vector<float> values{-1, 1, 0, -0.0f, 0.5f, -0.5f, 1e-30f, -1e-30f, 1e-45f, -1e-45f};
    // Numbers next to where two codes meet.
    for (int code = 0; code < 255; ++code) {
      const auto edge = static_cast<float>((2 * code + 1) / 255.0 - 1);
      values.insert(values.end(), {edge, std::nextafter(edge, -2.0f), std::nextafter(edge, 2.0f)});
    }
    for (const float n : values) {
      const Ratio exact =
          (Ratio(Dyadic(double{n})) + Ratio(Dyadic(1.0))) * greatest * Ratio(Dyadic(0.5));
      EXPECT_EQ(code_of_normal(n, bits), round_to_integer(exact, 65535)) << n << ", " << bits;
    }
  }
  EXPECT_EQ(code_of_normal(0, 8), 128);
  EXPECT_EQ(code_of_normal(-1e-45f, 8), 127);
  EXPECT_EQ(code_of_normal(0, 16), 32768);
}

TEST(NormalCodes, AreReadAsTheNearestNumber) {
  for (const int bits : {8, 16}) {
    const int greatest = bits == 8 ? 255 : 65535;
    for (int code = 0; code <= greatest; code += bits == 8 ? 1 : 37) {
      const auto read = normal_of_code(static_cast<std::uint16_t>(code), bits);
      const Ratio exact(Dyadic(2.0 * code - greatest), Dyadic(double(greatest)));
      EXPECT_EQ(read, round_to_binary32(exact)) << code;
      EXPECT_EQ(code_of_normal(read, bits), code);
    }
  }
}

TEST(NormalPictures, HaveTheirChannelAndBackground) {
  const DepthMap map = normals("Nc", {{0, 0, 0}, {1, 0, -1}, {-0.6f, 0.8f, 0}});
  for (const int bits : {8, 16}) {
    for (const NormalAxes axes : all_normal_axes) {
      const DepthMap back =
          decode_map(encode_map(map, "a.png", MapFormat::png, {.normals = {bits, axes}}), "a.png");
      ASSERT_EQ(back.channels.size(), 3u);
      const float step = 1.0f / (bits == 8 ? 255 : 65535);
      for (std::size_t part = 0; part < 3; ++part) {
        EXPECT_EQ(back.channels[part].name, map.channels[part].name);
        const auto &ours = *map.values<float>(back.channels[part].name),
                   &read = std::get<Samples<float>>(back.channels[part].values);
        EXPECT_EQ(read[0], 0);
        for (std::size_t k = 1; k < 3; ++k) EXPECT_NEAR(read[k], ours[k], step * 1.001f);
      }
      EXPECT_TRUE(back.texts.empty() || back.texts.count("fathom:type") == 0);
    }
  }
}

TEST(NormalPictures, AreReadByOtherProgramsByTheirFormula) {
  const Folder folder;
  const DepthMap map = normals("Nc", {{0, 0, 0}, {1, 0.25f, -1}});
  write_map(map, folder / "cv.png", MapFormat::png);
  write_map(map, folder / "gl.png", MapFormat::png, {.normals = {16, NormalAxes::opengl}});
  const Outcome outcome = run("cd '" + (folder / "").string() + R"(' && /usr/bin/python3 -c "
import OpenImageIO as oiio
for name, kind in (('cv.png', 'uint8'), ('gl.png', 'uint16')):
    print(oiio.ImageInput.open(name).read_image(kind).tolist())
")");
  // (1 + 0.25)·255/2 = 159.375; with y and z negated (1 − 0.25)·65535/2 = 24575.625.
  EXPECT_EQ(outcome.output, "[[[0, 0, 0], [255, 159, 0]]]\n[[[0, 0, 0], [65535, 24576, 65535]]]\n");
}

TEST(NormalPictures, OfWhatIsNoNormalAreRefused) {
  const auto refusal = [](const DepthMap& map, const NormalCoding& coding) {
    return message_of<Error>(
        [&] { encode_map(map, "a.png", MapFormat::png, {.normals = coding}); });
  };
  EXPECT_EQ(refusal(normals("N", {{0, 0, 1}, {0, 1.5f, 0}}), {}),
            "a.png: pixel (1, 0): N.Y is not from -1 to 1: no normal of length 1");
  EXPECT_THAT(refusal(normals("N", {{0, 0, std::nanf("")}}), {}), HasSubstr("N.Z is not from"));
  EXPECT_THAT(refusal(normals("N", {{0, 0, 1}}), {8, NormalAxes::opengl}),
              HasSubstr("normal_axes: those of OpenGL are for channel Nc"));
  EXPECT_THAT(refusal(normals("N", {{0, 0, 1}}), {12, NormalAxes::opencv}),
              HasSubstr("normal_bits: expected 8 or 16"));
  EXPECT_THAT(refusal(normals("P", {{0, 0, 1}}), {}), HasSubstr("holds one channel"));
}

TEST(MasksOfMaps, ShowSurfacesOrAnObjectAndAreRead) {
  DepthMap map = map_of(4, 1, "Z", std::vector<float>{1, INFINITY, INFINITY, 2});
  EXPECT_EQ(*decode_map(encode_mask(map, "m.png"), "m.png").values<float>("mask"),
            (Samples<float>{1, 0, 0, 1}));
  // A depth that overflowed is a surface where identifiers say so.
  map.channels.push_back({"object", Samples<std::uint32_t>{0, no_surface, 1, 1}});
  map.object_names = {"a", "b"};
  const DepthMap mask = decode_map(encode_mask(map, "m.png"), "m.png");
  EXPECT_EQ(*mask.values<float>("mask"), (Samples<float>{1, 0, 1, 1}));
  EXPECT_EQ(mask.object_names, map.object_names);
  EXPECT_EQ(*decode_map(encode_mask(map, "m.png", 1), "m.png").values<float>("mask"),
            (Samples<float>{0, 0, 1, 1}));
  map.channels.pop_back();
  EXPECT_THROW(encode_mask(map, "m.png", 1), UsageError);
}

TEST(MasksOfMaps, OfOtherProgramsAreStillPictures) {
  const std::vector<std::uint8_t> mask{0, 1};
  try {
    decode_map(encode_mask(mask, 2, 1, "m.png"), "m.png");
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a picture, not a depth map"));
  }
}

}  // namespace
}  // namespace fathom
