#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/parts/ideas.h"
#include "apps/bench/parts/tile_drawing.h"

namespace fathom::bench {
namespace {

Picture picture_of(const DepthImage& image) {
  Picture picture = image.depths.picture();
  const Picture numbers = image.numbers.picture();
  picture.insert(picture.end(), numbers.begin(), numbers.end());
  return picture;
}

double kilobytes(const DepthImage& image) {
  return static_cast<double>((image.depths.numbers.size() + image.numbers.numbers.size()) *
                             sizeof(double)) /
         1024;
}

}  // namespace

std::vector<Idea> tiles(const PartsScene& scene) {
  Idea idea{"tiles", {}, "8 lanes of binary64, one thread; a z-buffer of 16 bytes a pixel"};
  const auto expected = std::make_shared<const Picture>(exact_nearest(scene.window));
  const auto image = std::make_shared<DepthImage>(scene.window.width, scene.window.height);
  idea.variants.push_back({.name = "whole image",
                           .draw =
                               [image, &scene] {
                                 image->clear(0, 0);
                                 draw_nearest(scene.setups, *image);
                               },
                           .picture = [image] { return picture_of(*image); },
                           .counts = [image, &scene]() -> Counts {
                             return {
                                 {"tiles", 1},
                                 {"triangles x tiles", static_cast<double>(scene.setups.size())},
                                 {"KiB of a z-buffer", kilobytes(*image)}};
                           },
                           .expected = expected});
  for (const std::uint32_t side : {16U, 32U, 64U, 128U, 256U}) {
    const auto counted = std::make_shared<TileCounts>();
    idea.variants.push_back(
        {.name = fmt::format("tiles of {0}x{0}", side),
         .prepare = [image] { image->clear(0, 0); },
         .draw = [image, &scene, side,
                  counted] { *counted = draw_in_tiles(scene.setups, side, 1, *image); },
         .picture = [image] { return picture_of(*image); },
         .counts = [counted, side]() -> Counts {
           return {{"tiles", static_cast<double>(counted->tiles)},
                   {"triangles x tiles", static_cast<double>(counted->pairs)},
                   {"KiB of a z-buffer", kilobytes(DepthImage(side, side))}};
         },
         .expected = expected});
  }
  return {std::move(idea)};
}

}  // namespace fathom::bench
