#include "fathom/pipeline/geometry/window_triangle.h"

#include <algorithm>
#include <functional>
#include <random>

#include "fathom/numeric/rounding.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {

template <class Real>
std::array<GridPoint, 3> snapped(const WindowTriangle<Real>& t, int bits) {
  const auto at = [&](std::size_t k) {
    return snap(static_cast<double>(t.corners[k].x), static_cast<double>(t.corners[k].y), bits);
  };
  return {at(0), at(1), at(2)};
}

template <class Real>
Real depth_offset(const WindowTriangle<Real>& t, Storage storage, const DepthBias& bias) {
  if (bias.slope_factor == 0 && bias.constant_factor == 0) return 0;
  const auto number = [](Real x) { return Ratio(Dyadic(static_cast<double>(x))); };
  const auto& [a, b, c] = t.corners;
  const Real ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const Real vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const Real area = ux * vy - vx * uy;
  const WindowSlopes slopes{number((uz * vy - vz * uy) / area), number((ux * vz - vx * uz) / area),
                            number(std::max({a.z, b.z, c.z}))};
  return static_cast<Real>(round_to_binary64(depth_offset(storage, bias, slopes)));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                                               \
  template std::array<GridPoint, 3> snapped(const WindowTriangle<Real>&, int); \
  template Real depth_offset(const WindowTriangle<Real>&, Storage, const DepthBias&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

namespace {

template <class Real>
Real depth_of(const WindowTriangle<Real>& t) {
  check_interruption();  // in every comparison of a sort
  constexpr std::size_t D = attribute::depth;
  return t.corners[0].attributes[D] + t.corners[1].attributes[D] + t.corners[2].attributes[D];
}

/// Fisher and Yates; not std::shuffle, which each library does in its own way.
template <class T>
void shuffle(std::vector<T>& list, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t left = list.size(); left > 1; --left) {
    check_interruption();
    std::swap(list[left - 1], list[random() % left]);
  }
}

}  // namespace

template <class Real>
void put_into_draw_order(std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options) {
  using Triangle = WindowTriangle<Real>;
  switch (options.draw_order) {
    case DrawOrder::file:
      break;
    case DrawOrder::front_to_back:
      std::ranges::stable_sort(triangles, std::less<>(), depth_of<Real>);
      break;
    case DrawOrder::back_to_front:
      std::ranges::stable_sort(triangles, std::greater<>(), depth_of<Real>);
      break;
    case DrawOrder::random:
      shuffle<Triangle>(triangles, options.draw_seed);
      break;
  }
}

template void put_into_draw_order(std::vector<WindowTriangle<float>>&, const PipelineOptions&);
template void put_into_draw_order(std::vector<WindowTriangle<double>>&, const PipelineOptions&);

}  // namespace fathom::pipeline
