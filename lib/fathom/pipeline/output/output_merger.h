#pragma once

#include <functional>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/output/draw_rules.h"

/// Output merger: writes shaded fragments to samples and resolves the samples at the end.
namespace fathom::pipeline {

/// A picture of floating-point colours, row by row from the top left.
struct ColourImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Colour> pixels;

  [[nodiscard]] const Colour& at(std::uint32_t x, std::uint32_t y) const {
    return pixels[std::size_t{y} * width + x];
  }
};

/// The picture between pixels, interpolated linearly, with its border repeated; (0, 0) is the
/// centre of the first pixel.
Colour between(const ColourImage& image, double x, double y);

/// Rounded to 8 bits, to nearest.
RgbImage to_rgb(const ColourImage& image);

/// The stored values of a sample.
struct StoredSample {
  std::uint32_t id = no_surface;
  std::array<float, 3> colour{};
  StoredDepth stored;
  double depth = 0;            ///< along the view, of the triangle that `id` names
  bool depth_written = false;  ///< otherwise `stored` is the cleared value
  std::uint8_t stencil = 0;
};

/// Colour and depth buffer, `samples` per pixel, for the rows of an image from `first_row` on.
class FrameBuffer {
 public:
  FrameBuffer(std::uint32_t width, std::uint32_t height, std::size_t samples,
              const Colour& background, std::uint32_t first_row = 0, StoredDepth cleared = {});

  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }
  [[nodiscard]] std::size_t samples() const { return samples_; }
  [[nodiscard]] StoredSample& at(const Pixel& p, std::size_t sample) {
    return buffer_[index(p) + sample];
  }
  [[nodiscard]] const StoredSample& at(const Pixel& p, std::size_t sample) const {
    return buffer_[index(p) + sample];
  }

  /// Replaces the stored colour.
  void replace(const Pixel& p, std::size_t sample, const Colour& colour);
  /// Blends the colour over the stored colour, by its opacity. Fragments that are drawn first lie
  /// below, however near they are.
  void blend(const Pixel& p, std::size_t sample, const Colour& colour, double alpha);

  /// The mean of each pixel's samples.
  [[nodiscard]] ColourImage resolve() const;

 private:
  [[nodiscard]] std::size_t index(const Pixel& p) const {
    return (static_cast<std::size_t>(p.y - first_row_) * width_ + static_cast<std::size_t>(p.x)) *
           samples_;
  }

  std::uint32_t width_, height_, first_row_;
  std::size_t samples_;
  std::vector<StoredSample> buffer_;
};

/// A shaded fragment to be merged into a sample.
struct MergedFragment {
  std::uint32_t number = 0;  ///< of its primitive
  StoredDepth stored;
  double depth = 0;     ///< along the view
  double window_z = 0;  ///< as interpolated, for traces
};

/// Which test a fragment failed, if any.
enum class Outcome { stencil_failed, depth_failed, passed };

/// A fragment at the output merger: the sample before, the tests, the sample after.
struct MergeStep {
  Pixel pixel;
  std::size_t sample = 0;
  MergedFragment fragment;
  Colour colour{};
  StoredSample before, after;
  Outcome outcome = Outcome::passed;
  bool depth_tested = true;  ///< false for the painter's algorithm
  DrawRules rules;
};
/// Called for each merged fragment. With early depth tests, fragments that fail are not merged.
using ObserveMerge = std::function<void(const MergeStep&)>;

/// Tests fragments against samples and writes the results to the samples.
class OutputMerger {
 public:
  /// Without `depth_tested` all fragments pass: later fragments are on top.
  OutputMerger(const PipelineOptions& options, bool depth_tested, FrameBuffer& target,
               PipelineStatistics& statistics, const ObserveMerge* observe = nullptr)
      : test_(options),
        depth_tested_(depth_tested),
        target_(target),
        count_(statistics),
        observe_(observe) {}

  /// Sets the rules for all further fragments; they must outlive these.
  void begin(const DrawRules& rules) { rules_ = &rules; }

  [[nodiscard]] StoredDepth stored(const Fragment& fragment) const {
    return test_.stored(fragment);
  }
  /// Performs the stencil test, then the depth test; changes the stencil value by the rules.
  Outcome test(const Pixel& p, std::size_t sample, StoredDepth stored);
  /// Whether a fragment can change the picture.
  [[nodiscard]] bool is_wanted(Outcome outcome) const {
    return outcome == Outcome::passed ||
           (outcome == Outcome::depth_failed && rules_->blends_failed);
  }
  /// Writes depth and colour.
  void merge(const Pixel& p, std::size_t sample, const MergedFragment& fragment,
             const Colour& colour, Outcome outcome);

 private:
  [[nodiscard]] bool passes_depth_test(const StoredSample& there, StoredDepth stored) const;
  Outcome test_sample(StoredSample& there, StoredDepth stored);
  void write(const Pixel& p, std::size_t sample, const MergedFragment& fragment,
             const Colour& colour, Outcome outcome);

  DepthTest test_;
  bool depth_tested_;
  FrameBuffer& target_;
  PipelineStatistics& count_;
  const DrawRules* rules_ = nullptr;
  const ObserveMerge* observe_;
  StoredSample before_;  ///< the sample before its stencil test, if observed
};

}  // namespace fathom::pipeline
