#include "fathom/attribution/attribution.h"

#include <algorithm>
#include <numeric>

#include "fathom/attribution/attribute_bands.h"
#include "fathom/attribution/fragment_source.h"
#include "fathom/attribution/pixels/pixel_judge.h"
#include "fathom/attribution/pixels/statistics.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom::attribution {
namespace {

/// The fragments of all triangles at the pixels of some rows, pixel by pixel.
std::vector<std::vector<Fragment>> fragments_in(const FragmentSource& source,
                                                const std::vector<PixelBox>& boxes,
                                                std::uint32_t width, std::uint32_t first_row,
                                                std::uint32_t last_row) {
  std::vector<std::vector<Fragment>> found(std::size_t{width} * (last_row - first_row + 1));
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    PixelBox box = boxes[t];
    if (box.is_empty() || box.first_row > last_row || box.last_row < first_row) continue;
    box.first_row = std::max(box.first_row, first_row);
    box.last_row = std::min(box.last_row, last_row);
    source.each(t, box, [&](std::uint32_t column, std::uint32_t row, const Fragment& f) {
      found[std::size_t{row - first_row} * width + column].push_back(f);
    });
  }
  return found;
}

}  // namespace

Attribution attribute_bands(const Truth& truth, const OtherMap& other, const RendererModel& model,
                            const std::vector<std::uint32_t>& bands) {
  const StandardArithmetic standard;
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  const auto source = fragments(truth.mesh, truth.camera, model);
  std::vector<PixelBox> boxes(truth.mesh.triangles.size());
  parallel_for(std::size_t{0}, boxes.size(),
               [&](std::size_t t) { boxes[t] = source->box(static_cast<std::uint32_t>(t)); });

  const PixelJudge judge(truth, other, model);
  std::vector<PixelResult> pixels(std::size_t{width} * height);
  parallel_for(std::size_t{0}, bands.size(), [&](std::size_t k) {
    const std::uint32_t first = bands[k] * rows_per_band;
    const std::uint32_t last = std::min(first + rows_per_band, height) - 1;
    const auto found = fragments_in(*source, boxes, width, first, last);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t index = std::size_t{first} * width + i;
      pixels[index] = judge.judge(index, found[i]);
    }
  });
  return summary_of(pixels, truth);
}

Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model) {
  const StandardArithmetic standard;
  std::vector<std::uint32_t> bands((truth.camera.height + rows_per_band - 1) / rows_per_band);
  std::iota(bands.begin(), bands.end(), 0U);
  return attribute_bands(truth, other, model, bands);
}

}  // namespace fathom::attribution
