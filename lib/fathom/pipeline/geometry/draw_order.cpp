#include "fathom/pipeline/geometry/draw_order.h"

#include <algorithm>
#include <functional>
#include <random>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
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
