#include "fathom/pipeline/output/output_merger.h"

#include <algorithm>
#include <cmath>

#include "fathom/threads/interruption.h"

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
                         const Colour& background, std::uint32_t first_row, StoredDepth cleared)
    : width_(width),
      height_(height),
      first_row_(first_row),
      samples_(samples),
      buffer_(std::size_t{width} * height * samples,
              StoredSample{.colour = narrowed(background), .stored = cleared}) {}

void FrameBuffer::replace(const Pixel& p, std::size_t sample, const Colour& colour) {
  at(p, sample).colour = narrowed(colour);
}

void FrameBuffer::blend(const Pixel& p, std::size_t sample, const Colour& colour, double alpha) {
  auto& below = at(p, sample).colour;
  for (std::size_t k = 0; k < 3; ++k)
    below[k] = static_cast<float>(alpha * colour[k] + (1 - alpha) * static_cast<double>(below[k]));
}

bool OutputMerger::passes_depth_test(const StoredSample& there, StoredDepth stored) const {
  if (!depth_tested_) return true;
  if (rules_->depth_test) return compares(*rules_->depth_test, stored, there.stored);
  return !there.depth_written || test_.is_nearer(stored, there.stored);
}

Outcome OutputMerger::test(const Pixel& p, std::size_t sample, StoredDepth stored) {
  StoredSample& there = target_.at(p, sample);
  if (observe_ != nullptr) before_ = there;
  return test_sample(there, stored);
}

Outcome OutputMerger::test_sample(StoredSample& there, StoredDepth stored) {
  const auto depth_outcome = [&] {
    return passes_depth_test(there, stored) ? Outcome::passed : Outcome::depth_failed;
  };
  if (!rules_->stencil) return depth_outcome();
  const StencilState& s = *rules_->stencil;
  const auto masked = [&](std::uint8_t value) { return value & s.mask; };
  const bool stencil_passed = compares(s.test, masked(s.reference), masked(there.stencil));
  const Outcome outcome = stencil_passed ? depth_outcome() : Outcome::stencil_failed;
  const StencilAction action = !stencil_passed      ? s.fail
                               : is_wanted(outcome) ? s.pass
                                                    : s.depth_fail;
  there.stencil = after(action, s, there.stencil);
  return outcome;
}

void OutputMerger::merge(const Pixel& p, std::size_t sample, const MergedFragment& fragment,
                         const Colour& colour, Outcome outcome) {
  write(p, sample, fragment, colour, outcome);
  if (observe_ != nullptr)
    (*observe_)({p, sample, fragment, colour, before_, target_.at(p, sample), outcome,
                 depth_tested_, *rules_});
}

void OutputMerger::write(const Pixel& p, std::size_t sample, const MergedFragment& fragment,
                         const Colour& colour, Outcome outcome) {
  const bool passed = outcome == Outcome::passed;
  count_.depth_passed += passed;
  StoredSample& there = target_.at(p, sample);
  if (rules_->colour_write && rules_->alpha && is_wanted(outcome)) {
    target_.blend(p, sample, colour, *rules_->alpha);
  } else if (rules_->colour_write && passed) {
    target_.replace(p, sample, colour);
  }
  if (!passed) return;
  // The surface that shows through a blended surface without depth remains the surface of the
  // pixel.
  if (rules_->colour_write && (!rules_->alpha || rules_->depth_write)) {
    there.id = fragment.number;
    there.depth = fragment.depth;
  }
  if (!rules_->depth_write) return;
  there.stored = fragment.stored;
  there.depth_written = true;
}

ColourImage FrameBuffer::resolve() const {
  ColourImage image{width_, height_, std::vector<Colour>(std::size_t{width_} * height_)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    check_interruption();
    for (std::size_t s = 0; s < samples_; ++s)
      for (std::size_t k = 0; k < 3; ++k)
        image.pixels[i][k] += static_cast<double>(buffer_[i * samples_ + s].colour[k]);
    for (double& c : image.pixels[i]) c /= static_cast<double>(samples_);
  }
  return image;
}

}  // namespace fathom::pipeline
