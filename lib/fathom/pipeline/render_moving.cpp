#include "fathom/pipeline/render_moving.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/output/temporal_history.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

void require_increasing(const Shutter& shutter) {
  if (!std::isfinite(shutter.open) || !std::isfinite(shutter.close) ||
      !(shutter.open < shutter.close)) {
    throw UsageError(Setting{"shutter"}, "expected OPEN,CLOSE, two times, the second later");
  }
}

void add_counts(PipelineStatistics& all, const PipelineStatistics& one) {
  all.fragments += one.fragments;
  all.depth_passed += one.depth_passed;
  all.shaded += one.shaded;
}

/// The part `share` of the time that the shutter is open.
double time_at(const Shutter& shutter, double share) {
  return shutter.open + share * (shutter.close - shutter.open);
}

ColourImage mean_over_time(MovingScene& scene, const Camera& camera, const PipelineOptions& options,
                           const Shutter& shutter, PipelineStatistics& statistics) {
  const int n = options.antialias.count;
  PipelineOptions each = options;
  each.antialias = {options.antialias.method == AntialiasMethod::temporal ? AntialiasMethod::none
                                                                          : AntialiasMethod::area,
                    1};
  ColourImage sum;
  for (int k = 0; k < n; ++k) {
    const Scene& now = scene.at(time_at(shutter, (k + 0.5) / n));
    PipelineFrame frame = render_frame(now, camera, each, true);
    add_counts(statistics, frame.statistics);
    if (k == 0) {
      sum = std::move(frame.picture);
      continue;
    }
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) sum.pixels[i][c] += frame.picture.pixels[i][c];
  }
  for (Colour& colour : sum.pixels)
    for (double& c : colour) c /= n;
  return sum;
}

/// The camera whose pixel centres are at place k of Halton's sequence in this camera's pixels.
Camera moved_within_pixel(const Camera& camera, int k, std::array<double, 2>& offset) {
  const GridPoint p = GridSamples::halton(k).at({0, 0}, 0);
  offset = {static_cast<double>(p.x) / static_cast<double>(grid_one),
            static_cast<double>(p.y) / static_cast<double>(grid_one)};
  Camera moved = camera;
  moved.projection.cx -= offset[0];
  moved.projection.cy -= offset[1];
  return moved;
}

/// Pictures of a moving scene with their history.
class TemporalAntialiasing {
 public:
  TemporalAntialiasing(MovingScene& scene, const Camera& camera, const PipelineOptions& options,
                       const HistorySettings& settings)
      : scene_(scene), camera_(camera), options_(options), settings_(settings), history_(settings) {
    options_.antialias = {};
  }

  void add(double time, int k, PipelineStatistics& statistics) {
    std::array<double, 2> offset{};
    const Camera moved = moved_within_pixel(camera_, k, offset);
    const PipelineFrame frame = render_frame(scene_.at(time), moved, options_, true);
    add_counts(statistics, frame.statistics);
    history_.add(frame.picture,
                 k == 0 || !settings_.reprojected ? PixelMoves{} : moves(frame, offset, time));
    before_ = time;
  }

  [[nodiscard]] const ColourImage& picture() const { return history_.picture(); }

 private:
  /// A pixel moves like the nearest surface of the 3 × 3 pixels around, so that the smoothed
  /// outline of a surface moves with it [Kar14].
  [[nodiscard]] PixelMoves moves(const PipelineFrame& frame, const std::array<double, 2>& offset,
                                 double time) const {
    std::vector<std::optional<std::size_t>> nearest = nearest_around(frame);
    PixelMoves result(nearest.size(), PixelMove{});
    const auto place = [&](std::size_t pixel) {
      const std::size_t x = pixel % camera_.width, y = pixel / camera_.width;
      return std::array{static_cast<double>(x) + 0.5 + offset[0],
                        static_cast<double>(y) + 0.5 + offset[1]};
    };
    // The visible points, as weights of corners; then the previous positions of these corners.
    std::vector<std::optional<std::array<double, 3>>> weights(nearest.size());
    const ImageTriangles now(scene_.at(time), camera_);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (!nearest[i]) continue;
      const auto [u, v] = place(*nearest[i]);
      weights[i] = weights_at(now[frame.id[*nearest[i]]], u, v);
    }
    const ImageTriangles before(scene_.at(before_), camera_);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (!nearest[i]) continue;
      result[i] = std::nullopt;
      if (!weights[i]) continue;
      const auto there = place_of(before[frame.id[*nearest[i]]], *weights[i]);
      const auto [u, v] = place(*nearest[i]);
      if (there) result[i] = PixelMove{(*there)[0] - u, (*there)[1] - v};
    }
    return result;
  }

  /// For each pixel, the pixel around it with the nearest surface; nullopt if all are background,
  /// which is at rest.
  [[nodiscard]] std::vector<std::optional<std::size_t>> nearest_around(
      const PipelineFrame& frame) const {
    const std::size_t width = camera_.width, height = camera_.height;
    std::vector<std::optional<std::size_t>> nearest(width * height);
    for (std::size_t y = 0; y < height; ++y) {
      check_interruption();
      for (std::size_t x = 0; x < width; ++x) {
        std::optional<std::size_t>& best = nearest[y * width + x];
        for (std::size_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, height - 1); ++j) {
          for (std::size_t i = x == 0 ? 0 : x - 1; i <= std::min(x + 1, width - 1); ++i) {
            const std::size_t there = j * width + i;
            if (frame.id[there] == no_surface) continue;
            if (!best || frame.depth[there] < frame.depth[*best]) best = there;
          }
        }
      }
    }
    return nearest;
  }

  MovingScene& scene_;
  const Camera& camera_;
  PipelineOptions options_;
  HistorySettings settings_;
  TemporalHistory history_;
  double before_ = 0;
};

ColourImage with_history(MovingScene& scene, const Camera& camera, const PipelineOptions& options,
                         const Shutter& shutter, const HistorySettings& settings,
                         PipelineStatistics& statistics) {
  TemporalAntialiasing pictures(scene, camera, options, settings);
  const int n = options.antialias.count;
  for (int k = 0; k < n; ++k)
    pictures.add(n == 1 ? shutter.close : time_at(shutter, static_cast<double>(k) / (n - 1)), k,
                 statistics);
  return pictures.picture();
}

}  // namespace

PipelineFrame render_moving(MovingScene& scene, const Camera& camera,
                            const PipelineOptions& options, const Shutter& shutter,
                            bool with_picture, const HistorySettings& history) {
  const StandardArithmetic standard;
  require_meaningful(options);
  require_increasing(shutter);
  const AntialiasMethod method = options.antialias.method;
  const bool averaged =
      method == AntialiasMethod::temporal || method == AntialiasMethod::temporal_area;
  if (method == AntialiasMethod::taa && options.viewport)
    throw UsageError(Setting{"viewport"}, "taa of a moving scene draws to the whole image");
  if (method == AntialiasMethod::taa && has_lines_or_points(scene.at(shutter.open)))
    throw UsageError(Setting{"antialias"},
                     "taa of a moving scene follows triangles, and it has lines or points");
  PipelineOptions map_options = options;
  if (averaged || method == AntialiasMethod::taa) map_options.antialias = {};
  const bool is_picture = with_picture && !averaged && method != AntialiasMethod::taa;
  PipelineFrame frame = render_frame(scene.at(shutter.close), camera, map_options, is_picture);
  if (!with_picture || is_picture) return frame;
  frame.statistics.fragments = frame.statistics.depth_passed = frame.statistics.shaded = 0;
  frame.picture = averaged
                      ? mean_over_time(scene, camera, options, shutter, frame.statistics)
                      : with_history(scene, camera, options, shutter, history, frame.statistics);
  return frame;
}

}  // namespace fathom::pipeline
