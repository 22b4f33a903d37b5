#pragma once

#include <cstdint>
#include <vector>

#include "fathom/fast/setup/setup.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/triangle/recent_triangles.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

class VisibleTriangles;

/// Setups of triangles from exact numbers for all samples of an image, one for each thread: each of
/// many tiles needs them.
class ExactSetups {
 public:
  explicit ExactSetups(const PixelBox& image) : image_(image) {}
  const TriangleSetup& of(std::uint32_t number, triangle::Referee& referee, bool perspective) {
    return remembered_.get(number, [&](TriangleSetup& setup) {
      const auto wide = wide_setup(referee, number, image_);
      setup = wide ? *wide : exact_setup(referee.projected(number), perspective, image_);
    });
  }

 private:
  PixelBox image_;
  triangle::RecentTriangles<TriangleSetup, 4096> remembered_;
};

/// Column and row of the image.
struct DoubtfulPixel {
  std::uint32_t column, row;
};

/// The data with which a thread draws tiles.
struct DrawContext {
  triangle::Referee& referee;
  RenderStatistics& statistics;
  const DepthRange& range;
  bool perspective;
  const FastSwitches& switches;
  /// If not null, gets the pixels at which a bound does not settle a decision in binary32.
  std::vector<DoubtfulPixel>* doubtful = nullptr;
  /// Setups from exact numbers for the whole image: a cache of the last used setups.
  ExactSetups& exact_setups;
  /// For draw_tile().
  VisibleTriangles& visible;
  /// Whether bins have triangles that cover no sample.
  bool by_area = false;

  /// Sets up a triangle from exact numbers, for the samples of `box`.
  [[nodiscard]] TriangleSetup set_up_exactly(std::uint32_t number, const PixelBox& box) const {
    ++statistics.exact_setups;
    TriangleSetup setup = moved_to(exact_setups.of(number, referee, perspective), box);
    setup.edge_error *= switches.widening;
    setup.q_error *= switches.widening;
    return setup;
  }
  void note_doubt(std::uint32_t column, std::uint32_t row) const {
    if (doubtful) doubtful->push_back({column, row});
  }
};

}  // namespace fathom::fast
