#include "fathom/pipeline/output/output_merger.h"

#include <algorithm>
#include <cmath>

namespace fathom::pipeline {
namespace {

std::array<float, 3> narrowed(const Colour& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

}  // namespace

Colour between(const ColourImage& image, double x, double y) {
  x = std::clamp(x, 0.0, static_cast<double>(image.width - 1));
  y = std::clamp(y, 0.0, static_cast<double>(image.height - 1));
  const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
  const std::uint32_t i1 = std::min(i + 1, image.width - 1), j1 = std::min(j + 1, image.height - 1);
  const double s = x - i, t = y - j;
  Colour colour;
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = (1 - t) * ((1 - s) * image.at(i, j)[k] + s * image.at(i1, j)[k]) +
                t * ((1 - s) * image.at(i, j1)[k] + s * image.at(i1, j1)[k]);
  return colour;
}

RgbImage to_rgb(const ColourImage& image) {
  RgbImage rgb(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      rgb.pixels[i][k] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(image.pixels[i][k], 0.0, 1.0)));
  return rgb;
}

FrameBuffer::FrameBuffer(std::uint32_t width, std::uint32_t height, std::size_t samples,
                         const Colour& background, std::uint32_t first_row)
    : width_(width),
      height_(height),
      first_row_(first_row),
      samples_(samples),
      buffer_(std::size_t{width} * height * samples,
              StoredSample{no_surface, narrowed(background), {}, 0}) {}

void FrameBuffer::replace(const Pixel& p, std::size_t sample, std::uint32_t id, StoredDepth stored,
                          double depth, const Colour& colour) {
  at(p, sample) = {id, narrowed(colour), stored, depth};
}

void FrameBuffer::blend(const Pixel& p, std::size_t sample, const Colour& colour, double alpha) {
  auto& below = at(p, sample).colour;
  for (std::size_t k = 0; k < 3; ++k)
    below[k] = static_cast<float>(alpha * colour[k] + (1 - alpha) * static_cast<double>(below[k]));
}

ColourImage FrameBuffer::resolve() const {
  ColourImage image{width_, height_, std::vector<Colour>(std::size_t{width_} * height_)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (std::size_t s = 0; s < samples_; ++s)
      for (std::size_t k = 0; k < 3; ++k)
        image.pixels[i][k] += static_cast<double>(buffer_[i * samples_ + s].colour[k]);
    for (double& c : image.pixels[i]) c /= static_cast<double>(samples_);
  }
  return image;
}

}  // namespace fathom::pipeline
