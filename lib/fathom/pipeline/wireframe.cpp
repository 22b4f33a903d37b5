#include <algorithm>
#include <cmath>

#include "fathom/pipeline/diamond_exit.h"
#include "fathom/pipeline/line.h"
#include "fathom/pipeline/rasterizer.h"

namespace fathom::pipeline {
namespace {

template <class Real>
class EdgeDrawer {
 public:
  EdgeDrawer(const RasterizerSettings& settings, FrameBuffer& target,
             PipelineStatistics& statistics)
      : s_(settings), test_(settings.options), target_(target), count_(statistics) {}

  void draw(std::uint32_t number, const WindowVertex<Real>& a, const WindowVertex<Real>& b) {
    a_ = &a, b_ = &b, number_ = number;
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

 private:
  static std::int64_t column(Real x) { return floor_of(x); }

  /// The window depth of the line's point whose projection on it is nearest to the centre.
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
    const auto over_w = [&](const WindowVertex<Real>& v) {
      return v.attributes[attribute::depth] * v.inverse_w;
    };
    fragment.depth =
        static_cast<double>((over_w(*a_) + t * (over_w(*b_) - over_w(*a_))) / inverse_w);
    const StoredDepth stored = test_.stored(fragment);
    const StoredSample& there = target_.at(p, 0);
    if (there.id != no_surface && !test_.is_nearer(stored, there.stored)) return;
    ++count_.depth_passed;
    const auto& a = a_->attributes;
    target_.replace(
        p, 0, number_, stored, fragment.depth,
        {static_cast<double>(a[attribute::colour]), static_cast<double>(a[attribute::colour + 1]),
         static_cast<double>(a[attribute::colour + 2])});
  }

  const RasterizerSettings& s_;
  DepthTest test_;
  FrameBuffer& target_;
  PipelineStatistics& count_;
  const WindowVertex<Real>*a_ = nullptr, *b_ = nullptr;
  std::uint32_t number_ = 0;
};

}  // namespace

template <class Real>
void rasterize_edges(const std::vector<WindowTriangle<Real>>& triangles,
                     const RasterizerSettings& settings, FrameBuffer& target,
                     PipelineStatistics& statistics) {
  EdgeDrawer<Real> drawer(settings, target, statistics);
  for (const WindowTriangle<Real>& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) drawer.draw(t.number, t.corners[k], t.corners[(k + 1) % 3]);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Real)                                          \
  template void rasterize_edges(const std::vector<WindowTriangle<Real>>&, \
                                const RasterizerSettings&, FrameBuffer&, PipelineStatistics&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
