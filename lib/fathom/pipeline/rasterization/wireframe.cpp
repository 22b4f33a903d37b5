#include <algorithm>

#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/line.h"

namespace fathom::pipeline {
namespace {

template <class Real>
class OutlineDrawer {
 public:
  OutlineDrawer(const RasterizerSettings& settings, FrameBuffer& target,
                PipelineStatistics& statistics)
      : s_(settings),
        merger_(s_.options, s_.depth_tested, target, statistics, s_.observe),
        samples_(target.samples()),
        count_(statistics) {}

  void draw(const WindowLine<Real>& line) {
    const auto& [a, b] = line.ends;
    begin(line.number, line.object, a, b);
    const LineEnds ends{column(a.x), column(a.y), column(b.x), column(b.y)};
    const auto visit = [&](const Pixel& p, const auto&) { put(p); };
    switch (s_.options.wire_line) {
      case WireLine::explicit_equation:
        return explicit_line<Real>(ends, s_.window, visit);
      case WireLine::dda:
        return dda_line<Real>(ends, s_.window, visit);
      case WireLine::bresenham:
        return bresenham_line(ends, s_.window, visit);
      case WireLine::midpoint:
        return midpoint_line(ends, s_.window, visit);
      case WireLine::diamond_exit:
        return diamond_exit_line<Real>({a.x, a.y, b.x, b.y}, s_.window,
                                       [&](const Pixel& p) { put(p); });
    }
  }

  void draw(const WindowPoint<Real>& point) {
    begin(point.number, point.object, point.place, point.place);
    const Pixel p{column(point.place.x), column(point.place.y)};
    const PixelWindow& w = s_.window;
    if (p.x >= w.x_begin && p.x < w.x_end && p.y >= w.y_begin && p.y < w.y_end) put(p);
  }

 private:
  void begin(std::uint32_t number, std::uint32_t object, const WindowVertex<Real>& a,
             const WindowVertex<Real>& b) {
    a_ = &a, b_ = &b, number_ = number;
    merger_.begin(s_.rules[object]);
  }

  static std::int64_t column(Real x) { return floor_of(x); }

  /// Draws a pixel at the window depth of the line's point that is nearest to its centre.
  void put(const Pixel& p) {
    ++count_.fragments;
    const Real dx = b_->x - a_->x, dy = b_->y - a_->y, length2 = dx * dx + dy * dy;
    const Real t = length2 > 0 ? std::clamp(((centre_of<Real>(p.x) - a_->x) * dx +
                                             (centre_of<Real>(p.y) - a_->y) * dy) /
                                                length2,
                                            Real(0), Real(1))
                               : Real(0);
    Fragment fragment;
    fragment.window_z = std::clamp(static_cast<double>(a_->z + t * (b_->z - a_->z)), 0.0, 1.0);
    const Real inverse_w = a_->inverse_w + t * (b_->inverse_w - a_->inverse_w);
    const auto perspective = [&](std::size_t i) {
      const Real a = a_->attributes[i] * a_->inverse_w, b = b_->attributes[i] * b_->inverse_w;
      return static_cast<double>((a + t * (b - a)) / inverse_w);
    };
    const auto at = [&](std::size_t i) {
      if (s_.options.interpolation == Interpolation::perspective) return perspective(i);
      return static_cast<double>(a_->attributes[i] + t * (b_->attributes[i] - a_->attributes[i]));
    };
    fragment.depth = perspective(attribute::depth);
    const StoredDepth stored = merger_.stored(fragment);
    const Colour colour{at(attribute::colour), at(attribute::colour + 1),
                        at(attribute::colour + 2)};
    // Lines and points fill whole pixels, all samples alike.
    for (std::size_t i = 0; i < samples_; ++i) {
      const Outcome outcome = merger_.test(p, i, stored);
      merger_.merge(p, i, {number_, stored, fragment.depth, fragment.window_z}, colour, outcome);
    }
  }

  const RasterizerSettings& s_;
  OutputMerger merger_;
  std::size_t samples_;
  PipelineStatistics& count_;
  const WindowVertex<Real>*a_ = nullptr, *b_ = nullptr;
  std::uint32_t number_ = 0;
};

}  // namespace

template <class Real>
void rasterize_lines(const std::vector<WindowLine<Real>>& lines, const RasterizerSettings& settings,
                     FrameBuffer& target, PipelineStatistics& statistics) {
  OutlineDrawer<Real> drawer(settings, target, statistics);
  for (const WindowLine<Real>& line : lines) drawer.draw(line);
}

template <class Real>
void rasterize_points(const std::vector<WindowPoint<Real>>& points,
                      const RasterizerSettings& settings, FrameBuffer& target,
                      PipelineStatistics& statistics) {
  OutlineDrawer<Real> drawer(settings, target, statistics);
  for (const WindowPoint<Real>& point : points) drawer.draw(point);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Real)                                                                   \
  template void rasterize_lines(const std::vector<WindowLine<Real>>&, const RasterizerSettings&,   \
                                FrameBuffer&, PipelineStatistics&);                                \
  template void rasterize_points(const std::vector<WindowPoint<Real>>&, const RasterizerSettings&, \
                                 FrameBuffer&, PipelineStatistics&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
