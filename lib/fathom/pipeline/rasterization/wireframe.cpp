#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/threads/interruption.h"

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
    if (s_.outlines_have_area) return fill();
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
    if (s_.outlines_have_area) return fill();
    const Pixel p{column(point.place.x), column(point.place.y)};
    const PixelWindow& w = s_.window;
    if (p.x >= w.x_begin && p.x < w.x_end && p.y >= w.y_begin && p.y < w.y_end) put(p);
  }

 private:
  void begin(std::uint32_t number, std::uint32_t object, const WindowVertex<Real>& a,
             const WindowVertex<Real>& b) {
    check_interruption();
    a_ = &a, b_ = &b, number_ = number;
    is_point_ = &a == &b;
    length_ = std::hypot(b.x - a.x, b.y - a.y);
    merger_.begin(s_.rules[object]);
  }

  static std::int64_t column(Real x) { return floor_of(x); }

  /// A place of the window as the line has it: how far along it from its first end, and how far to
  /// its side, in pixels.
  struct AlongLine {
    Real along, aside;
  };
  [[nodiscard]] AlongLine along_line(Real x, Real y) const {
    const Real ux = length_ > 0 ? (b_->x - a_->x) / length_ : Real(1);
    const Real uy = length_ > 0 ? (b_->y - a_->y) / length_ : Real(0);
    return {(x - a_->x) * ux + (y - a_->y) * uy, (y - a_->y) * ux - (x - a_->x) * uy};
  }

  /// Whether the rectangle of the line has a place, or the square of the point; half-open, so that
  /// rectangles side by side share none.
  [[nodiscard]] bool has(const AlongLine& place) const {
    const Real half(0.5);
    const Real first = is_point_ ? -half : Real(0), last = is_point_ ? half : length_;
    return first <= place.along && place.along < last && -half <= place.aside && place.aside < half;
  }

  /// Draws the samples in the area of the line or point.
  void fill() {
    const auto [left, right] = std::minmax(a_->x, b_->x);
    const auto [top, bottom] = std::minmax(a_->y, b_->y);
    const Real one(1);
    const std::int64_t x_end = std::min(column(right + one) + 1, s_.window.x_end);
    const std::int64_t y_end = std::min(column(bottom + one) + 1, s_.window.y_end);
    for (std::int64_t y = std::max(column(top - one), s_.window.y_begin); y < y_end; ++y) {
      check_interruption();
      for (std::int64_t x = std::max(column(left - one), s_.window.x_begin); x < x_end; ++x)
        fill({x, y});
    }
  }

  void fill(const Pixel& p) {
    covered_.clear();
    for (std::size_t i = 0; i < samples_; ++i) {
      const GridPoint offset = s_.pattern.at(p, i), sample = sample_of(p, offset.x, offset.y);
      const auto one = static_cast<Real>(grid_one);
      const AlongLine place =
          along_line(static_cast<Real>(sample.x) / one, static_cast<Real>(sample.y) / one);
      if (has(place)) covered_.push_back({i, place.along});
    }
    if (covered_.empty()) return;
    ++count_.fragments;
    // Once for each pixel, at the mean of the covered samples, or for each sample.
    Real mean(0);
    for (const auto& [i, along] : covered_) mean += along / static_cast<Real>(covered_.size());
    const Colour once = colour_at(share_of(mean));
    for (const auto& [i, along] : covered_) {
      const Real t = share_of(along);
      merge(p, i, fragment_at(t), s_.rate == ShadingRate::per_pixel ? once : colour_at(t));
    }
  }

  [[nodiscard]] Real share_of(Real along) const {
    return length_ > 0 ? std::clamp(along / length_, Real(0), Real(1)) : Real(0);
  }

  /// Draws a pixel at the window depth of the line's point that is nearest to its centre.
  void put(const Pixel& p) {
    ++count_.fragments;
    const Real dx = b_->x - a_->x, dy = b_->y - a_->y, length2 = dx * dx + dy * dy;
    const Real t = length2 > 0 ? std::clamp(((centre_of<Real>(p.x) - a_->x) * dx +
                                             (centre_of<Real>(p.y) - a_->y) * dy) /
                                                length2,
                                            Real(0), Real(1))
                               : Real(0);
    const Fragment fragment = fragment_at(t);
    const Colour colour = colour_at(t);
    // All samples alike.
    for (std::size_t i = 0; i < samples_; ++i) merge(p, i, fragment, colour);
  }

  [[nodiscard]] double perspective(std::size_t i, Real t) const {
    const Real inverse_w = a_->inverse_w + t * (b_->inverse_w - a_->inverse_w);
    const Real a = a_->attributes[i] * a_->inverse_w, b = b_->attributes[i] * b_->inverse_w;
    return static_cast<double>((a + t * (b - a)) / inverse_w);
  }

  /// At a part of the way along the line.
  [[nodiscard]] Fragment fragment_at(Real t) const {
    Fragment fragment;
    fragment.window_z = std::clamp(static_cast<double>(a_->z + t * (b_->z - a_->z)), 0.0, 1.0);
    fragment.depth = perspective(attribute::depth, t);
    return fragment;
  }

  [[nodiscard]] Colour colour_at(Real t) const {
    const auto at = [&](std::size_t i) {
      if (s_.options.interpolation == Interpolation::perspective) return perspective(i, t);
      return static_cast<double>(a_->attributes[i] + t * (b_->attributes[i] - a_->attributes[i]));
    };
    return {at(attribute::colour), at(attribute::colour + 1), at(attribute::colour + 2)};
  }

  void merge(const Pixel& p, std::size_t sample, const Fragment& fragment, const Colour& colour) {
    const StoredDepth stored = merger_.stored(fragment);
    const Outcome outcome = merger_.test(p, sample, stored);
    merger_.merge(p, sample, {number_, stored, fragment.depth, fragment.window_z}, colour, outcome);
  }

  const RasterizerSettings& s_;
  OutputMerger merger_;
  std::size_t samples_;
  PipelineStatistics& count_;
  const WindowVertex<Real>*a_ = nullptr, *b_ = nullptr;
  std::uint32_t number_ = 0;
  bool is_point_ = false;
  Real length_ = 0;
  /// The samples of a pixel that the area has, and how far along.
  std::vector<std::pair<std::size_t, Real>> covered_;
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

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
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
