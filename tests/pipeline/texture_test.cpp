#include "fathom/pipeline/fragments/texture.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/trace.h"
#include "tests/inputs/scene_building.h"

/// Texels worked out by hand. Textures here are grey: 51 is 1/5.
namespace fathom::pipeline {
namespace {

using Uv = std::array<double, 2>;

RgbImage grey(std::uint32_t width, const std::vector<int>& codes) {
  RgbImage image(width, static_cast<std::uint32_t>(codes.size()) / width);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto c = static_cast<std::uint8_t>(codes[i]);
    image.pixels[i] = {c, c, c};
  }
  return image;
}

/// Upper left 0, upper right 1, lower left 1/5, lower right 2/5. Texel centres at ¼ and ¾.
const RgbImage two_by_two = grey(2, {0, 255,  //
                                     51, 102});
/// In fifteenths.
const RgbImage four_by_four = grey(4, {0, 17, 34, 51,       //
                                       68, 85, 102, 119,    //
                                       136, 153, 170, 187,  //
                                       204, 221, 238, 255});

double looked_up(const RgbImage& image, TextureFilter filter, const Uv& uv, const Uv& dx = {0, 0},
                 const Uv& dy = {0, 0}) {
  return Texture(image).sample({uv, dx, dy}, filter)[1];
}

constexpr double rounding_error = 1e-14;

/// A quarter of the way from one texel to the next, in each component.
TEST(TextureByHand, EachComponentIsMixedByItself) {
  RgbImage image(2, 1);
  image.pixels = {{0, 51, 102}, {255, 204, 153}};
  const Colour c = Texture(image).sample({{0.375, 0.5}, {}, {}}, TextureFilter::bilinear);
  EXPECT_NEAR(c[0], 0.25, rounding_error);
  EXPECT_NEAR(c[1], 0.35, rounding_error);
  EXPECT_NEAR(c[2], 0.45, rounding_error);
  // Between the texels 5, 6, 9 and 10, at 1.25 and 1.5 of their centres.
  EXPECT_NEAR(looked_up(four_by_four, TextureFilter::bilinear, {0.4375, 0.5}), 7.25 / 15,
              rounding_error);
}

/// The coarsest level of a row or a column, odd ones too, is one texel.
TEST(TextureByHand, LevelsOfRowsAndColumns) {
  for (const RgbImage& image : {grey(4, {0, 51, 102, 255}), grey(1, {0, 51, 102, 255})}) {
    for (const TextureFilter filter : {TextureFilter::trilinear, TextureFilter::anisotropic}) {
      EXPECT_NEAR(looked_up(image, filter, {0.3, 0.7}, {100, 0}, {0, 100}), 0.4, rounding_error);
    }
  }
  // Of three, the last has no partner and is left out: ⌊3/2⌋ = 1.
  EXPECT_NEAR(
      looked_up(grey(3, {0, 51, 255}), TextureFilter::trilinear, {0.5, 0.5}, {9, 0}, {0, 9}), 0.1,
      rounding_error);
  EXPECT_EQ(looked_up(grey(1, {102}), TextureFilter::trilinear, {0.5, 0.5}, {9, 0}, {0, 9}), 0.4);
}

TEST(TextureByHand, NearestTakesTheTexelThatItIsIn) {
  const auto at = [](double u, double v) {
    return looked_up(two_by_two, TextureFilter::nearest, {u, v});
  };
  EXPECT_EQ(at(0.25, 0.75), 0);
  EXPECT_EQ(at(0.75, 0.75), 1);
  EXPECT_EQ(at(0.25, 0.25), 51 / 255.);
  EXPECT_EQ(at(0.75, 0.25), 102 / 255.);
  // Texels own their left and lower sides; (0, 0) is the lower left corner.
  EXPECT_EQ(at(0, 0), 51 / 255.);
  EXPECT_EQ(at(0.5, 0), 102 / 255.);
  EXPECT_EQ(at(std::nextafter(0.5, 0), 0), 51 / 255.);
  EXPECT_EQ(at(0, 0.5), 0);
  EXPECT_EQ(at(0, std::nextafter(0.5, 0)), 51 / 255.);
}

TEST(TextureByHand, CoordinatesWrapAround) {
  for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::bilinear}) {
    for (const double u : {0.25, 0.375, 0.75}) {
      for (const double v : {0.25, 0.5, 0.875}) {
        const double once = looked_up(two_by_two, filter, {u, v});
        for (const double turns : {-3., -1., 1., 1024.}) {
          EXPECT_EQ(looked_up(two_by_two, filter, {u + turns, v}), once);
          EXPECT_EQ(looked_up(two_by_two, filter, {u, v + turns}), once);
        }
      }
    }
  }
  // Just below 0 is just below 1, also where their difference rounds to 1; no number at all is 0.
  const auto at = [](double u, double v) {
    return looked_up(two_by_two, TextureFilter::nearest, {u, v});
  };
  EXPECT_EQ(at(-0x1p-20, 0.25), 102 / 255.);
  EXPECT_EQ(at(1, 1), at(0, 0));
  EXPECT_TRUE(at(-1e-300, 0.25) == at(0, 0.25) || at(-1e-300, 0.25) == at(0.75, 0.25));
  EXPECT_EQ(at(NAN, INFINITY), at(0, 0));
}

TEST(TextureByHand, BilinearMixesFourTexels) {
  const auto at = [](double u, double v) {
    return looked_up(two_by_two, TextureFilter::bilinear, {u, v});
  };
  EXPECT_EQ(at(0.25, 0.75), 0);  // at the centres, the texels
  EXPECT_EQ(at(0.75, 0.25), 102 / 255.);
  EXPECT_NEAR(at(0.5, 0.5), (0 + 1 + 0.2 + 0.4) / 4, rounding_error);
  EXPECT_NEAR(at(0.375, 0.75), 0.25, rounding_error);        // a quarter of the way from 0 to 1
  EXPECT_NEAR(at(0.25, 0.625), 0.25 * 0.2, rounding_error);  // down from 0 to 1/5
  EXPECT_NEAR(at(0.375, 0.625), 0.75 * (0.25 * 1) + 0.25 * (0.75 * 0.2 + 0.25 * 0.4),
              rounding_error);
  // Over the sides, the texels of the other side.
  EXPECT_NEAR(at(0, 0.75), 0.5, rounding_error);
  EXPECT_NEAR(at(0.25, 0), 0.1, rounding_error);
  EXPECT_NEAR(at(0, 0), 0.4, rounding_error);
}

TEST(TextureByHand, MipLevelsAreMeans) {
  // Level 1, in fifteenths: means of 0 1 4 5, of 2 3 6 7, of 8 9 12 13, of 10 11 14 15.
  EXPECT_EQ(Texture(four_by_four).level_count(), 3U);
  const auto at = [](double u, double v, double texels) {
    return looked_up(four_by_four, TextureFilter::trilinear, {u, v}, {texels / 4, 0});
  };
  EXPECT_NEAR(at(0.25, 0.75, 2), 2.5 / 15, rounding_error);
  EXPECT_NEAR(at(0.75, 0.75, 2), 4.5 / 15, rounding_error);
  EXPECT_NEAR(at(0.25, 0.25, 2), 10.5 / 15, rounding_error);
  EXPECT_NEAR(at(0.75, 0.25, 2), 12.5 / 15, rounding_error);
  EXPECT_NEAR(at(0.25, 0.25, 4), 7.5 / 15, rounding_error);    // level 2
  EXPECT_NEAR(at(0.25, 0.25, 400), 7.5 / 15, rounding_error);  // there is no other
  // Odd sizes drop what is left over: 3 × 1 becomes the mean of its first two.
  EXPECT_NEAR(looked_up(grey(3, {0, 102, 255}), TextureFilter::trilinear, {0.5, 0.5}, {100, 0}),
              0.2, rounding_error);
}

TEST(TextureByHand, TrilinearMixesTwoLevels) {
  const auto at = [](const Uv& dx, const Uv& dy) {
    return looked_up(four_by_four, TextureFilter::trilinear, {0.125, 0.125}, dx, dy);
  };
  // At the lower left texel's centre: 12/15 in level 0. In level 1 between its four texels, a
  // quarter of the way over either side: (9·10.5 + 3·12.5 + 3·2.5 + 4.5)/16 = 9 fifteenths.
  EXPECT_NEAR(at({0.25, 0}, {0, 0.25}), 12. / 15, rounding_error);  // a texel a pixel
  EXPECT_NEAR(at({0.1, 0}, {0, 0.1}), 12. / 15, rounding_error);    // less
  EXPECT_NEAR(at({0.5, 0}, {0, 0.25}), 9. / 15, rounding_error);    // two: the longer counts
  EXPECT_NEAR(at({0, 0.25}, {0.3, 0.4}), 9. / 15, rounding_error);  // √(1.2² + 1.6²) = 2
  EXPECT_NEAR(at({std::sqrt(2.) / 4, 0}, {0, 0}), 10.5 / 15, rounding_error);  // √2: level ½
  EXPECT_NEAR(at({std::sqrt(2.) / 2, 0}, {0, 0}), 8.25 / 15, rounding_error);  // 2√2: level 1½
}

TEST(TextureByHand, AnisotropicLooksAlongTheLongerSide) {
  const auto at = [](const Uv& uv, const Uv& dx, const Uv& dy) {
    return looked_up(four_by_four, TextureFilter::anisotropic, uv, dx, dy);
  };
  // Four texels along u, one along v: four looks in level 0, at the centres of a row.
  EXPECT_NEAR(at({0.5, 0.125}, {1, 0}, {0, 0.25}), (12 + 13 + 14 + 15) / 60., rounding_error);
  EXPECT_NEAR(at({0.5, 0.875}, {1, 0}, {0, 0.25}), (0 + 1 + 2 + 3) / 60., rounding_error);
  // And along v: a column, where trilinear filtering has the mean of all.
  EXPECT_NEAR(at({0.125, 0.5}, {0.25, 0}, {0, 1}), (0 + 4 + 8 + 12) / 60., rounding_error);
  EXPECT_NEAR(looked_up(four_by_four, TextureFilter::trilinear, {0.125, 0.5}, {0.25, 0}, {0, 1}),
              7.5 / 15, rounding_error);
  // Two texels either way: one look, level 1.
  EXPECT_NEAR(at({0.25, 0.25}, {0.5, 0}, {0, 0.5}), 10.5 / 15, rounding_error);
  // Two by one: two looks, half of the longer side apart, in level 0.
  EXPECT_NEAR(at({0.25, 0.125}, {0.5, 0}, {0, 0.25}), (12 + 13) / 30., rounding_error);
  // 64 by 1: 16 looks, each of 4 texels: all of level 2.
  EXPECT_NEAR(at({0.1, 0.1}, {16, 0}, {0, 0.25}), 7.5 / 15, rounding_error);
  // Less than a texel: one look where it is.
  EXPECT_NEAR(at({0.125, 0.125}, {0.01, 0}, {0, 0.0001}), 12. / 15, rounding_error);
  EXPECT_NEAR(at({0.125, 0.125}, {0, 0}, {0, 0}), 12. / 15, rounding_error);
}

/// A square at depth 8 that fills 8 × 8 pixels, its texture `repeats` times on either side.
Scene square(double repeats) {
  Scene scene =
      checks::scene_of({{0, 0, 8}, {8, 0, 8}, {8, 8, 8}, {0, 8, 8}}, {{0, 2, 1}, {0, 3, 2}});
  scene.meshes[0].texture_coordinates = {{0, repeats}, {repeats, repeats}, {repeats, 0}, {0, 0}};
  return scene;
}

Camera camera_of_eight() {
  Camera camera = checks::camera_of(8, 8, 8);
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

/// Red at (x, y) of a scene without light. Pictures are kept in binary32.
double drawn(const Scene& scene, const RgbImage& texture, TextureFilter filter, std::size_t x,
             std::size_t y, Interpolation interpolation = Interpolation::perspective) {
  const std::string file =
      ::testing::TempDir() + "fathom-texture-" + std::to_string(::getpid()) + ".png";
  write_png(texture, file);
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.texture = file;
  options.filter = filter;
  options.interpolation = interpolation;
  const double red =
      render_frame(scene, camera_of_eight(), options, true).picture.pixels.at(y * 8 + x)[0];
  std::filesystem::remove(file);
  return red;
}

constexpr double kept = 0x1p-25 + rounding_error;

TEST(TextureByHand, AtNamedPixels) {
  // Texels of 4 × 4 pixels. Pixel (1, 6) has u = 1.5/8, v = 1.5/8: in the lower left texel.
  const auto at = [](TextureFilter filter, std::size_t x, std::size_t y) {
    return drawn(square(1), two_by_two, filter, x, y);
  };
  EXPECT_NEAR(at(TextureFilter::nearest, 1, 6), 0.2, kept);
  EXPECT_NEAR(at(TextureFilter::nearest, 3, 4), 0.2, kept);
  EXPECT_NEAR(at(TextureFilter::nearest, 4, 4), 0.4, kept);
  EXPECT_NEAR(at(TextureFilter::nearest, 4, 3), 1, kept);
  EXPECT_NEAR(at(TextureFilter::nearest, 3, 3), 0, kept);
  // (3, 1): u = 3.5/8, 3/8 of the way from left to right; v = 6.5/8, 1/8 of the way from the upper
  // row to the lower one of the repetition above.
  const double upper = 0.375 * 1, lower = 0.625 * 0.2 + 0.375 * 0.4;
  EXPECT_NEAR(at(TextureFilter::bilinear, 3, 1), 0.875 * upper + 0.125 * lower, kept);
  // Enlarged, the finer filters are the same.
  EXPECT_NEAR(at(TextureFilter::trilinear, 3, 1), 0.875 * upper + 0.125 * lower, kept);
  EXPECT_NEAR(at(TextureFilter::anisotropic, 3, 1), 0.875 * upper + 0.125 * lower, kept);
}

TEST(TextureByHand, ReducedAtNamedPixels) {
  // Four repetitions of 4 × 4 texels in 8 pixels: two texels a pixel, level 1, at its texels'
  // centres. Eight: four texels a pixel, level 2.
  for (const TextureFilter filter : {TextureFilter::trilinear, TextureFilter::anisotropic}) {
    EXPECT_NEAR(drawn(square(4), four_by_four, filter, 2, 5), 10.5 / 15, kept);
    EXPECT_NEAR(drawn(square(4), four_by_four, filter, 3, 5), 12.5 / 15, kept);
    EXPECT_NEAR(drawn(square(4), four_by_four, filter, 3, 2), 4.5 / 15, kept);
    EXPECT_NEAR(drawn(square(8), four_by_four, filter, 3, 2), 7.5 / 15, kept);
  }
  // The checkerboard of 8 × 8 squares, each of them a pixel: white and black in turn, the upper
  // left one white. Eight repetitions: grey, but for the nearest texel.
  const auto checkered = [](double repeats, TextureFilter filter, std::size_t x, std::size_t y) {
    PipelineOptions options;
    options.precision = Precision::binary64;
    options.shading = Shading::none;
    options.texture = "checker";
    options.filter = filter;
    return render_frame(square(repeats), camera_of_eight(), options, true)
        .picture.pixels.at(y * 8 + x)[0];
  };
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(checkered(1, TextureFilter::nearest, i % 8, i / 8), (i % 8 + i / 8) % 2 == 0 ? 1 : 0);
    EXPECT_NEAR(checkered(8, TextureFilter::trilinear, i % 8, i / 8), 0.5, kept);
    EXPECT_NEAR(checkered(8, TextureFilter::anisotropic, i % 8, i / 8), 0.5, kept);
  }
  EXPECT_NE(std::fmod(checkered(8, TextureFilter::nearest, 3, 3), 1), 0.5);
}

TEST(TextureByHand, InPerspective) {
  // A floor-like square: the upper side at depth 16, the lower at 8, u across and v along. Row y
  // has v = (1 − s)/16 / (s/8 + (1 − s)/16) with s = (y + ½)/8: row 2, s = 5/16: (11/256)/(21/256);
  // affinely 11/16.
  Scene scene =
      checks::scene_of({{0, 0, 16}, {16, 0, 16}, {8, 8, 8}, {0, 8, 8}}, {{0, 2, 1}, {0, 3, 2}});
  scene.meshes[0].texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  // Rows of 1 × 64 texels, row k from the bottom of colour k/255·4: v·64 = 33.5 and 44.
  std::vector<int> codes;
  for (int k = 63; k >= 0; --k) codes.push_back(4 * k);
  const RgbImage ramp = grey(1, codes);
  EXPECT_NEAR(drawn(scene, ramp, TextureFilter::nearest, 4, 2), 4 * 33 / 255., kept);
  EXPECT_NEAR(drawn(scene, ramp, TextureFilter::nearest, 4, 2, Interpolation::affine),
              4 * 44 / 255., kept);
  // Between texel centres 33.5 is at row 33's own centre, 64·11/21 = 33.5238: 0.0238 above it.
  EXPECT_NEAR(drawn(scene, ramp, TextureFilter::bilinear, 4, 2), 4 * (64 * 11. / 21 - 0.5) / 255,
              kept);
}

/// What libpng writes of rows of packed samples.
std::vector<std::byte> png_of(std::uint32_t width, std::uint32_t height, int depth, int type,
                              std::vector<std::vector<png_byte>> rows,
                              const std::function<void(png_structp, png_infop)>& more = {}) {
  std::vector<std::byte> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, png_size_t n) {
        auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
        const auto* from = reinterpret_cast<const std::byte*>(data);
        out.insert(out.end(), from, from + n);
      },
      nullptr);
  png_set_IHDR(png, info, width, height, depth, type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (more) more(png, info);
  png_write_info(png, info);
  for (auto& row : rows) png_write_row(png, row.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::vector<Rgb> colours(const std::vector<std::byte>& bytes) {
  return decode_rgb_png(bytes, "texture.png").pixels;
}
Rgb grey_code(int code) {
  const auto c = static_cast<std::uint8_t>(code);
  return {c, c, c};
}

TEST(TextureFiles, GreyOfEveryDepth) {
  EXPECT_EQ(colours(png_of(3, 1, 1, PNG_COLOR_TYPE_GRAY, {{0b01000000}})),
            (std::vector<Rgb>{grey_code(0), grey_code(255), grey_code(0)}));
  EXPECT_EQ(colours(png_of(4, 1, 2, PNG_COLOR_TYPE_GRAY, {{0b00011011}})),
            (std::vector<Rgb>{grey_code(0), grey_code(85), grey_code(170), grey_code(255)}));
  EXPECT_EQ(colours(png_of(2, 1, 4, PNG_COLOR_TYPE_GRAY, {{0x1f}})),
            (std::vector<Rgb>{grey_code(17), grey_code(255)}));
  EXPECT_EQ(colours(png_of(2, 1, 8, PNG_COLOR_TYPE_GRAY, {{7, 200}})),
            (std::vector<Rgb>{grey_code(7), grey_code(200)}));
  // 16 bits: c·65535/255 is c; between, the nearest.
  EXPECT_EQ(colours(png_of(3, 1, 16, PNG_COLOR_TYPE_GRAY, {{0x80, 0x80, 0x80, 0xf0, 0x81, 0x20}})),
            (std::vector<Rgb>{grey_code(0x80), grey_code(0x80), grey_code(0x81)}));
}

TEST(TextureFiles, ColoursAndPalettes) {
  EXPECT_EQ(colours(png_of(2, 1, 8, PNG_COLOR_TYPE_RGB, {{1, 2, 3, 250, 251, 252}})),
            (std::vector<Rgb>{{1, 2, 3}, {250, 251, 252}}));
  EXPECT_EQ(colours(png_of(1, 1, 16, PNG_COLOR_TYPE_RGB, {{9, 9, 90, 90, 200, 200}})),
            (std::vector<Rgb>{{9, 90, 200}}));
  const std::array<png_color, 4> palette{{{1, 2, 3}, {40, 50, 60}, {70, 80, 90}, {200, 210, 220}}};
  const auto with_palette = [&](png_structp png, png_infop info) {
    png_set_PLTE(png, info, palette.data(), png_get_bit_depth(png, info) == 1 ? 2 : 4);
  };
  const std::vector<Rgb> all{{1, 2, 3}, {40, 50, 60}, {70, 80, 90}, {200, 210, 220}};
  EXPECT_EQ(colours(png_of(4, 1, 2, PNG_COLOR_TYPE_PALETTE, {{0b00011011}}, with_palette)), all);
  EXPECT_EQ(colours(png_of(4, 1, 4, PNG_COLOR_TYPE_PALETTE, {{0x01, 0x23}}, with_palette)), all);
  EXPECT_EQ(colours(png_of(4, 1, 8, PNG_COLOR_TYPE_PALETTE, {{0, 1, 2, 3}}, with_palette)), all);
  EXPECT_EQ(colours(png_of(2, 1, 1, PNG_COLOR_TYPE_PALETTE, {{0b10000000}}, with_palette)),
            (std::vector<Rgb>{{40, 50, 60}, {1, 2, 3}}));
}

TEST(TextureFiles, AnIndexBeyondThePaletteIsRefused) {
  const std::array<png_color, 3> palette{{{1, 2, 3}, {40, 50, 60}, {70, 80, 90}}};
  const auto why = [&](int depth, std::vector<std::vector<png_byte>> rows, int colours) {
    const auto bytes = png_of(
        4, 2, depth, PNG_COLOR_TYPE_PALETTE, std::move(rows), [&](png_structp png, png_infop info) {
          png_set_PLTE(png, info, palette.data(), colours);
          png_set_check_for_invalid_index(png, -1);  // libpng would not write it
        });
    try {
      decode_rgb_png(bytes, "texture.png");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string begin = "texture.png: broken PNG file: pixel ";
  EXPECT_EQ(why(8, {{0, 1, 2, 0}, {0, 2, 2, 1}}, 3), "none");
  EXPECT_EQ(why(8, {{0, 1, 2, 0}, {0, 3, 2, 1}}, 3),
            begin + "(1, 1): the index 3 is beyond the palette, which has 3 colours");
  EXPECT_EQ(why(8, {{0, 1, 2, 255}, {0, 3, 2, 1}}, 3),
            begin + "(3, 0): the index 255 is beyond the palette, which has 3 colours");
  EXPECT_EQ(why(4, {{0x00, 0x0f}, {0x00, 0x00}}, 2),
            begin + "(3, 0): the index 15 is beyond the palette, which has 2 colours");
  EXPECT_EQ(why(2, {{0b00011011}, {0}}, 3),
            begin + "(3, 0): the index 3 is beyond the palette, which has 3 colours");
  EXPECT_EQ(why(1, {{0b00010000}, {0}}, 1),
            begin + "(3, 0): the index 1 is beyond the palette, which has 1 colour");
}

TEST(TextureFiles, AlphaIsOverBlack) {
  // Opaque: the colour. Nothing: black. 128/255 of white, in linear light: 255·(128/255)^(1/2.2) is
  // 186.4.
  EXPECT_EQ(colours(png_of(3, 1, 8, PNG_COLOR_TYPE_RGBA,
                           {{10, 20, 30, 255, 10, 20, 30, 0, 255, 255, 255, 128}})),
            (std::vector<Rgb>{{10, 20, 30}, {0, 0, 0}, grey_code(186)}));
  EXPECT_EQ(colours(png_of(2, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {{77, 255, 77, 0}})),
            (std::vector<Rgb>{grey_code(77), grey_code(0)}));
  const auto transparent = [](png_structp png, png_infop info) {
    png_color_16 colour{};
    colour.gray = 7;
    png_set_tRNS(png, info, nullptr, 0, &colour);
  };
  EXPECT_EQ(colours(png_of(2, 1, 8, PNG_COLOR_TYPE_GRAY, {{7, 8}}, transparent)),
            (std::vector<Rgb>{grey_code(0), grey_code(8)}));
}

/// The same file with another width and height in its header, and its checksum.
std::vector<std::byte> with_size(std::vector<std::byte> bytes, std::uint32_t width,
                                 std::uint32_t height) {
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[at + i] = static_cast<std::byte>(value >> (24 - 8 * i));
  };
  put(16, width);
  put(20, height);
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint32_t>(bytes[i]);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
  }
  put(29, ~crc);
  return bytes;
}

TEST(TextureFiles, SizesThatCannotBe) {
  const std::vector<std::byte> one = png_of(1, 1, 8, PNG_COLOR_TYPE_GRAY, {{7}});
  ASSERT_EQ(colours(with_size(one, 1, 1)), (std::vector<Rgb>{grey_code(7)}));
  const auto why = [&](std::uint32_t width, std::uint32_t height) -> std::string {
    try {
      decode_rgb_png(with_size(one, width, height), "texture.png");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const auto& [width, height] : {std::pair{0U, 0U},
                                      {0U, 1U},
                                      {1U, 0U},
                                      {8193U, 1U},
                                      {65536U, 65536U},
                                      {2147483647U, 2147483647U}}) {
    EXPECT_EQ(why(width, height), "texture.png: " + std::to_string(width) + "x" +
                                      std::to_string(height) +
                                      " texels; a texture has 1x1 to 8192x8192");
  }
  // Cut within the signature, and within the size.
  const auto cut = [&](std::size_t bytes) -> std::string {
    try {
      decode_rgb_png(std::span(one).first(bytes), "texture.png");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(cut(0), "texture.png: is empty, expected a PNG file");
  EXPECT_EQ(cut(7), "texture.png: is no PNG file");
  EXPECT_EQ(cut(8).rfind("texture.png: broken PNG file", 0), 0U) << cut(8);
  EXPECT_EQ(cut(20).rfind("texture.png: broken PNG file", 0), 0U) << cut(20);
  EXPECT_NE(why(8192, 8192).find("too short"), std::string::npos);
}

/// What a triangle's trace says of a sample is what is drawn there, its texture included.
TEST(TextureByHand, TraceShowsTheColourThatIsDrawn) {
  Scene scene = checks::scene_of({{-2, -1.5, 4}, {3, -1, 9}, {0.25, 2, 20}}, {{0, 1, 2}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {8, 0}, {3, 9}};
  const Camera camera = checks::camera_of(16, 12, 16);
  PipelineOptions options;
  options.texture = "checker";
  options.filter = TextureFilter::nearest;
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  int black = 0, white = 0;
  for (std::uint32_t y = 0; y < 12; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const auto sample = trace_triangle(scene, camera, options, 0, Pixel{x, y}).sample;
      ASSERT_TRUE(sample);
      ASSERT_EQ(sample->covered, frame.id[y * 16 + x] == 0);
      if (!sample->covered) continue;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(static_cast<float>(sample->colour[k]),
                  static_cast<float>(frame.picture.at(x, y)[k]));
      (sample->colour[0] > 0 ? white : black) += 1;
    }
  }
  EXPECT_GT(black, 5);
  EXPECT_GT(white, 5);
}

/// Also where no picture is asked for.
TEST(TextureFiles, AMissingOneIsSaidToBe) {
  Scene scene = checks::scene_of({{-2, -1.5, 4}, {3, -1, 9}, {0.25, 2, 20}}, {{0, 1, 2}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {8, 0}, {3, 9}};
  const Camera camera = checks::camera_of(16, 12, 16);
  PipelineOptions options;
  options.texture = "/nowhere/texture.png";
  EXPECT_THROW(render_frame(scene, camera, options, false), InputError);
  EXPECT_THROW(trace_triangle(scene, camera, options, 0, std::nullopt), InputError);
}

TEST(TextureFiles, ATextureHasTexels) {
  EXPECT_THROW(Texture(RgbImage(0, 0)), InputError);
  EXPECT_THROW(Texture(RgbImage(4, 0)), InputError);
  RgbImage lacking(2, 2);
  lacking.pixels.pop_back();
  EXPECT_THROW(Texture{lacking}, InputError);
}

}  // namespace
}  // namespace fathom::pipeline
