#include <algorithm>
#include <limits>
#include <optional>

#include "fathom/depth_buffer/buffer_work.h"
#include "fathom/depth_format/encode.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/projected_triangle.h"

// How to read this file: fill_exactly() at the end is the whole story. Every number is exact and
// rounded once.
namespace fathom::depth_buffer {
using namespace area;
using namespace triangle;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

ProjectedTriangle projected(const BufferWork& work, std::uint32_t number) {
  TierCounts counts;
  return project(work.triangles.world_corners(number), number, work.camera, counts);
}

class ExactBand {
 public:
  ExactBand(const BufferWork& work, const TriangleBands::Band& band)
      : work_(work), format_(work.options.format), band_(band) {}

  /// Stores the visible surfaces.
  void store(DepthBufferStatistics& statistics) const {
    for_each_pixel(band_.first_row, band_.end_row, 0, work_.camera.width - 1,
                   [&](std::size_t pixel, const ImagePoint& s) {
                     const std::uint32_t visible = work_.channels.id[pixel];
                     if (visible == no_surface) return;
                     store(pixel, depth_at(projected(work_, visible), s));
                     ++statistics.by_exact_numbers;
                   });
  }

  /// Draws the triangles, in the order of their numbers, where they have the visible code.
  void find_winners(DepthBufferStatistics& statistics) const {
    for (const BoxedTriangle& boxed : band_.triangles) draw(boxed);
    for_each_pixel(band_.first_row, band_.end_row, 0, work_.camera.width - 1,
                   [&](std::size_t pixel, const ImagePoint&) {
                     const bool fights = work_.channels.winner[pixel] != work_.channels.id[pixel];
                     work_.channels.fight[pixel] = fights ? 1 : 0;
                     statistics.fighting += fights ? 1 : 0;
                   });
  }

 private:
  template <class Visit>
  void for_each_pixel(std::uint32_t first_row, std::uint32_t end_row, std::uint32_t first_column,
                      std::uint32_t last_column, const Visit& visit) const {
    for (std::uint32_t row = first_row; row < end_row; ++row) {
      for (std::uint32_t column = first_column; column <= last_column; ++column) {
        const std::size_t pixel = static_cast<std::size_t>(row) * work_.camera.width + column;
        visit(pixel, centre_of_pixel(column, row));
      }
    }
  }

  void store(std::size_t pixel, const Ratio& depth) const {
    const StoredDepth stored = encode(format_, depth);
    work_.channels.store(pixel, stored);
    const std::optional<Real> decoded = decode(format_, stored);
    work_.channels.decoded[pixel] = decoded ? round_to_binary32(*decoded) : infinity;
    if (!work_.channels.error) return;
    work_.channels.error[pixel] =
        decoded ? round_to_binary32(difference(*decoded, depth)) : infinity;
  }

  void draw(const BoxedTriangle& boxed) const {
    const ProjectedTriangle t = projected(work_, boxed.number);
    if (t.orientation == Sign::zero || !is_kept(t, work_.options.render.cull)) return;
    const PixelBox& box = boxed.box;
    for_each_pixel(std::max(box.first_row, band_.first_row),
                   std::min(box.last_row + 1, band_.end_row), box.first_column, box.last_column,
                   [&](std::size_t pixel, const ImagePoint& s) {
                     if (work_.channels.id[pixel] == no_surface) return;
                     const bool first_wins = work_.options.equal_depths == EqualDepths::first_wins;
                     if (first_wins && work_.channels.winner[pixel] != no_surface) return;
                     TierCounts counts;
                     if (!covers(t, s, counts)) return;
                     const Ratio depth = depth_at(t, s);
                     if (!is_in_range(depth, work_.camera)) return;
                     if (encode(format_, depth) != work_.channels.stored(pixel)) return;
                     work_.channels.winner[pixel] = boxed.number;
                   });
  }

  const BufferWork& work_;
  const DepthFormat& format_;
  TriangleBands::Band band_;
};

}  // namespace

DepthBufferStatistics fill_exactly(const BufferWork& work) {
  const BufferBands bands(work);
  std::vector<DepthBufferStatistics> parts(bands.count());
  parallel_for(std::uint32_t{0}, bands.count(), [&](std::uint32_t i) {
    const ExactBand band(work, bands[i]);
    band.store(parts[i]);
    if (work.options.against_exact) band.find_winners(parts[i]);
  });
  return sum_of(parts);
}

}  // namespace fathom::depth_buffer
