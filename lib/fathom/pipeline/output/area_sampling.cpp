#include "fathom/pipeline/output/area_sampling.h"

#include <algorithm>

#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/pipeline/scan/arithmetic.h"

namespace fathom::pipeline {
namespace {

using Ring = clipping::Ring<Exact>;
using Rings = clipping::Rings<Exact>;
using Point = clipping::Point2<Exact>;

/// The part of a triangle in a pixel.
struct Part {
  std::size_t triangle;
  Ring ring;  ///< in grid units, counter-clockwise as clippers see it
  GridPoint centroid;
  StoredDepth stored;
};

Ring square_of(const Pixel& p) {
  const Exact x0(p.x * grid_one), y0(p.y * grid_one), x1((p.x + 1) * grid_one),
      y1((p.y + 1) * grid_one);
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

GridPoint centroid_of(const Ring& ring) {
  // The mean of the corners lies inside a convex ring.
  double x = 0, y = 0;
  for (const auto& p : ring) x += clipping::to_binary64(p.x), y += clipping::to_binary64(p.y);
  const auto n = static_cast<double>(ring.size());
  return {static_cast<std::int64_t>(x / n), static_cast<std::int64_t>(y / n)};
}

/// The part of a convex ring on one side of the line a → b: on the left, with y up, for sign 1.
Ring side_of(const Ring& ring, const Point& a, const Point& b, int sign) {
  return clipping::ring_of(clipping::clip_at_boundary(
      clipping::corners_of(ring),
      [&](const Point& p) { return Exact(-sign * clipping::cross(a, b, p)); }));
}

/// Cuts what a convex ring covers out of convex pieces that do not overlap; returns its area.
Exact cut_out(Rings& pieces, const Ring& ring) {
  Exact area(0);
  Rings left;
  for (const Ring& piece : pieces) {
    Ring inside = piece;
    for (std::size_t i = 0; i < ring.size() && !inside.empty(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      Ring outside = side_of(inside, a, b, -1);
      if (!outside.empty()) left.push_back(std::move(outside));
      inside = side_of(inside, a, b, 1);
    }
    if (!inside.empty()) area += clipping::signed_area(inside);
  }
  pieces = std::move(left);
  return area;
}

template <class Real>
class AreaSampler {
 public:
  AreaSampler(const std::vector<WindowTriangle<Real>>& triangles, const PipelineOptions& options,
              Shader<Real>& shader, PipelineStatistics& statistics)
      : options_(options), test_(options), shader_(shader), count_(statistics) {
    for (const auto& t : triangles)
      if (auto i = Interpolator<Real>::of(t, options)) interpolators_.push_back(std::move(*i));
  }

  /// For each pixel of the window, row by row, the triangles that can touch it.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> bins(const PixelWindow& w) const {
    const auto width = static_cast<std::size_t>(w.x_end - w.x_begin);
    std::vector<std::vector<std::uint32_t>> bins(width *
                                                 static_cast<std::size_t>(w.y_end - w.y_begin));
    for (std::size_t i = 0; i < interpolators_.size(); ++i) {
      const GridTriangle& t = interpolators_[i].grid();
      const PixelWindow box = t.bounding_box();
      for (auto y = std::max(box.y_begin, w.y_begin); y < std::min(box.y_end, w.y_end); ++y)
        for (auto x = std::max(box.x_begin, w.x_begin); x < std::min(box.x_end, w.x_end); ++x)
          if (t.test_block({x, y}, 1) != GridTriangle::BlockCoverage::none)
            bins[static_cast<std::size_t>(y - w.y_begin) * width +
                 static_cast<std::size_t>(x - w.x_begin)]
                .push_back(static_cast<std::uint32_t>(i));
    }
    return bins;
  }

  Colour colour_of(const Pixel& pixel, const std::vector<std::uint32_t>& touching) {
    std::vector<Part> parts;
    for (const std::uint32_t i : touching)
      if (auto part = part_of(i, pixel)) parts.push_back(std::move(*part));
    std::stable_sort(parts.begin(), parts.end(), [&](const Part& a, const Part& b) {
      return test_.is_nearer(a.stored, b.stored);
    });
    Rings left{square_of(pixel)};
    Colour sum{};
    const Exact whole = Exact(grid_one) * Exact(grid_one);
    for (const Part& part : parts) {
      if (left.empty()) break;
      const Exact area = cut_out(left, part.ring);
      if (area > 0) add(sum, shade(part), clipping::to_binary64(Exact(area / whole)));
    }
    if (!left.empty())
      add(sum, options_.background,
          clipping::to_binary64(Exact(clipping::signed_area(left) / whole)));
    return sum;
  }

 private:
  static void add(Colour& sum, const Colour& colour, double weight) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * colour[k];
  }

  std::optional<Part> part_of(std::size_t i, const Pixel& pixel) {
    const auto corners = snapped(interpolators_[i].triangle(), options_.subpixel_bits);
    Ring ring;
    for (const GridPoint& c : corners) ring.push_back({Exact(c.x), Exact(c.y)});
    if (clipping::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    ring = clipping::ring_of(
        clipping::sutherland_hodgman(clipping::corners_of(ring), square_of(pixel)));
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3 || clipping::signed_area(ring) == 0) return std::nullopt;
    ++count_.fragments;
    const GridPoint centroid = centroid_of(ring);
    return Part{i, std::move(ring), centroid, test_.stored(interpolators_[i].depths_at(centroid))};
  }

  Colour shade(const Part& part) {
    ++count_.shaded;
    const Interpolator<Real>& t = interpolators_[part.triangle];
    shader_.begin(t.triangle());
    Fragment fragment;
    t.complete(fragment, part.centroid);
    return shader_.shade(fragment, t.attribute_weights(part.centroid));
  }

  const PipelineOptions& options_;
  DepthTest test_;
  Shader<Real>& shader_;
  PipelineStatistics& count_;
  std::vector<Interpolator<Real>> interpolators_;
};

}  // namespace

template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, std::uint32_t width, std::uint32_t height,
                         PipelineStatistics& statistics) {
  ColourImage image{width, height,
                    std::vector<Colour>(std::size_t{width} * height, options.background)};
  AreaSampler<Real> sampler(triangles, options, shader, statistics);
  const auto bins = sampler.bins(window);
  std::size_t k = 0;
  for (std::int64_t y = window.y_begin; y < window.y_end; ++y)
    for (std::int64_t x = window.x_begin; x < window.x_end; ++x, ++k)
      if (!bins[k].empty())
        image.pixels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
            sampler.colour_of({x, y}, bins[k]);
  return image;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Real)                                                               \
  template ColourImage area_sampled(const std::vector<WindowTriangle<Real>>&,                  \
                                    const PipelineOptions&, const PixelWindow&, Shader<Real>&, \
                                    std::uint32_t, std::uint32_t, PipelineStatistics&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
