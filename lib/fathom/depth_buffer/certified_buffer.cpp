#include <algorithm>
#include <limits>
#include <optional>

#include "fathom/depth_buffer/buffer_work.h"
#include "fathom/depth_format/certified_format.h"
#include "fathom/depth_format/encode.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/referee.h"

// How to read this file: fill_certified() at the end is the whole story; exact_buffer.cpp does the
// same without bounds. Each value is tried in binary64, then in double-words, then in exact
// numbers.
namespace fathom::depth_buffer {
using namespace area;
using namespace triangle;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The buffers of a thread.
struct Worker {
  CertifiedSurfaces surfaces;
  Referee referee;
  Worker(const TriangleSource& triangles, const Camera& camera, const SceneRays& rays)
      : surfaces(rays), referee(triangles, camera, &rays) {}
};

/// The rounded number if the bound settles it; +∞ is no bound.
std::optional<float> rounded(const Certified<double>& x) {
  return to_binary32(x.value, x.error);
}
std::optional<float> rounded(const Certified<WordPair>& x) {
  return to_binary32(x.value, x.error);
}

class CertifiedBand {
 public:
  CertifiedBand(const BufferWork& work, const CertifiedFormat& format,
                const TriangleBands::Band& band, Worker& worker, DepthBufferStatistics& statistics)
      : work_(work),
        channels_(work.channels),
        format_(format),
        band_(band),
        worker_(worker),
        statistics_(statistics) {}

  /// Stores the visible surfaces.
  void store() {
    for (std::uint32_t row = band_.first_row; row < band_.end_row; ++row) {
      for (std::uint32_t column = 0; column < work_.camera.width; ++column) {
        const std::size_t pixel = pixel_at(column, row);
        const std::uint32_t visible = channels_.id[pixel];
        if (visible == no_surface) continue;
        const ImagePoint s = centre_of_pixel(column, row);
        const StoredDepth stored = encode_visible(visible, s);
        channels_.store(pixel, stored);
        channels_.decoded[pixel] = decoded(stored);
        if (channels_.error) channels_.error[pixel] = error(stored, visible, s);
      }
    }
  }

  /// Draws the triangles that win from the visible one where they can have its code: those with
  /// lower numbers where the first of equals wins, else those with higher ones.
  void find_winners() {
    find_ends();
    for (const BoxedTriangle& boxed : band_.triangles) draw(boxed);
    for (std::uint32_t row = band_.first_row; row < band_.end_row; ++row) {
      for (std::uint32_t column = 0; column < work_.camera.width; ++column) {
        const std::size_t pixel = pixel_at(column, row);
        std::uint32_t& winner = channels_.winner[pixel];
        const bool fights = winner != no_surface;
        if (!fights) winner = channels_.id[pixel];
        channels_.fight[pixel] = fights ? 1 : 0;
        statistics_.fighting += fights ? 1 : 0;
      }
    }
  }

 private:
  [[nodiscard]] std::size_t pixel_at(std::uint32_t column, std::uint32_t row) const {
    return static_cast<std::size_t>(row) * work_.camera.width + column;
  }

  Ratio exact_depth(std::uint32_t number, const ImagePoint& s) {
    return depth_at(worker_.referee.projected(number), s);
  }

  StoredDepth encode_visible(std::uint32_t number, const ImagePoint& s) {
    if (const auto stored = format_.encode(worker_.surfaces.depth(number, s))) {
      ++statistics_.by_binary64;
      return *stored;
    }
    if (const auto stored = format_.encode(worker_.surfaces.wide_depth(number, s))) {
      ++statistics_.by_double_words;
      return *stored;
    }
    ++statistics_.by_exact_numbers;
    return fathom::encode(format_.format(), exact_depth(number, s));
  }

  /// The depth that a stored value means. Neighbouring pixels often have the same one.
  float decoded(StoredDepth stored) {
    if (has_last_ && stored == last_stored_) return last_decoded_;
    has_last_ = true;
    last_stored_ = stored;
    if (const auto narrow = rounded(format_.decode(stored))) return last_decoded_ = *narrow;
    if (const auto wide = rounded(format_.wide_decode(stored))) return last_decoded_ = *wide;
    const std::optional<Real> depth = fathom::decode(format_.format(), stored);
    return last_decoded_ = depth ? round_to_binary32(*depth) : static_cast<float>(infinity);
  }

  float error(StoredDepth stored, std::uint32_t number, const ImagePoint& s) {
    using Wide = DoubleWord<false>;
    const Certified<WordPair> depth = worker_.surfaces.wide_depth(number, s);
    const Certified<WordPair> back = format_.wide_decode(stored);
    const Certified<Wide> off = sum(Certified<Wide>{back.value, back.error},
                                    Certified<Wide>{-Wide(depth.value), depth.error});
    if (const auto settled = rounded(Certified<WordPair>{off.value, off.error})) return *settled;
    const std::optional<Real> exact = fathom::decode(format_.format(), stored);
    if (!exact) return static_cast<float>(infinity);
    return round_to_binary32(difference(*exact, exact_depth(number, s)));
  }

  /// For each pixel of the band, how far depths with its code reach; −∞ without a surface.
  void find_ends() {
    ends_.assign(static_cast<std::size_t>(band_.end_row - band_.first_row) * work_.camera.width,
                 -infinity);
    const std::size_t first = pixel_at(0, band_.first_row);
    std::optional<StoredDepth> last;
    double end = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      if (channels_.id[first + i] == no_surface) continue;
      const StoredDepth stored = channels_.stored(first + i);
      if (last != stored) end = format_.farthest_stored_as(stored);
      last = stored;
      ends_[i] = end;
    }
  }

  void draw(const BoxedTriangle& boxed) {
    const bool first_wins = work_.options.equal_depths == EqualDepths::first_wins;
    const std::size_t first = pixel_at(0, band_.first_row);
    const std::uint32_t end_row = std::min(boxed.box.last_row + 1, band_.end_row);
    for (std::uint32_t row = std::max(boxed.box.first_row, band_.first_row); row < end_row; ++row) {
      for (std::uint32_t column = boxed.box.first_column; column <= boxed.box.last_column;
           ++column) {
        const std::size_t pixel = pixel_at(column, row);
        const std::uint32_t visible = channels_.id[pixel];
        if (visible == no_surface || boxed.number == visible) continue;
        if ((boxed.number < visible) != first_wins) continue;
        if (first_wins && channels_.winner[pixel] != no_surface) continue;
        if (wins(boxed.number, pixel, ends_[pixel - first], centre_of_pixel(column, row))) {
          channels_.winner[pixel] = boxed.number;
        }
      }
    }
  }

  /// Whether a triangle covers the sample, counts there, and has the visible code.
  bool wins(std::uint32_t number, std::size_t pixel, double end, const ImagePoint& s) {
    const Certified<double> depth = worker_.surfaces.depth(number, s);
    if (depth.value - depth.error > end * (1 + 0x1p-50)) return false;
    if (worker_.surfaces.certainly_misses(number, s)) return false;
    RenderStatistics uncounted;
    if (!worker_.referee.covers(number, s, uncounted)) return false;
    if (!worker_.referee.is_in_range(number, s, uncounted)) return false;
    const Cull cull = work_.options.render.cull;
    if (cull != Cull::none && !is_kept(worker_.referee.projected(number), cull)) return false;
    return encode_other(number, depth, s) == channels_.stored(pixel);
  }

  StoredDepth encode_other(std::uint32_t number, const Certified<double>& depth,
                           const ImagePoint& s) {
    if (const auto stored = format_.encode(depth)) return *stored;
    if (const auto stored = format_.encode(worker_.surfaces.wide_depth(number, s))) return *stored;
    return fathom::encode(format_.format(), exact_depth(number, s));
  }

  const BufferWork& work_;
  BufferChannels& channels_;
  const CertifiedFormat& format_;
  TriangleBands::Band band_;
  Worker& worker_;
  DepthBufferStatistics& statistics_;
  bool has_last_ = false;
  StoredDepth last_stored_;
  float last_decoded_ = 0;
  std::vector<double> ends_;
};

}  // namespace

DepthBufferStatistics fill_certified(const BufferWork& work) {
  const CertifiedFormat format(work.options.format);
  const SceneRays rays(work.triangles, work.camera);
  PerThread<Worker> workers([&] { return Worker(work.triangles, work.camera, rays); });
  const BufferBands bands(work);
  std::vector<DepthBufferStatistics> parts(bands.count());
  parallel_for(std::uint32_t{0}, bands.count(), [&](std::uint32_t i) {
    CertifiedBand band(work, format, bands[i], workers.local(), parts[i]);
    band.store();
    if (work.options.against_exact) band.find_winners();
  });
  return sum_of(parts);
}

}  // namespace fathom::depth_buffer
