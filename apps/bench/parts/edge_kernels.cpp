#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "apps/bench/parts/edge_kernels.cpp"
#include "apps/bench/parts/edge_kernels.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "fathom/fast/lanes/lanes-inl.h"

// Products and sums are written apart: a fused one would round binary32 elsewhere on processors
// that have it, and would gain nothing where there is nothing to round.
HWY_BEFORE_NAMESPACE();
namespace fathom::bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The edge functions of a triangle, the same in all lanes.
template <class D>
struct Edges {
  using Number = hn::TFromD<D>;
  using V = hn::Vec<D>;

  HWY_INLINE explicit Edges(const EdgeSetup& s)
      : right0(hn::Set(D(), static_cast<Number>(s.right[0]))),
        right1(hn::Set(D(), static_cast<Number>(s.right[1]))),
        right2(hn::Set(D(), static_cast<Number>(s.right[2]))),
        least0(hn::Set(D(), static_cast<Number>(s.least[0]))),
        least1(hn::Set(D(), static_cast<Number>(s.least[1]))),
        least2(hn::Set(D(), static_cast<Number>(s.least[2]))) {}

  /// At the beginning of a row of the box.
  static HWY_INLINE V at_row(const EdgeSetup& s, std::size_t k, std::int32_t y) {
    return hn::Set(D(), static_cast<Number>(s.start[k]) +
                            static_cast<Number>(s.down[k]) * static_cast<Number>(y));
  }

  HWY_INLINE hn::Mask<D> cover(V row0, V row1, V row2, V x) const {
    return hn::And(hn::And(hn::Ge(hn::Add(row0, hn::Mul(right0, x)), least0),
                           hn::Ge(hn::Add(row1, hn::Mul(right1, x)), least1)),
                   hn::Ge(hn::Add(row2, hn::Mul(right2, x)), least2));
  }

  V right0, right1, right2, least0, least1, least2;
};

template <class D, class Number>
HWY_INLINE void add_where(D d, hn::Mask<D> mask, hn::Vec<D> weight, Number* place) {
  if (hn::AllFalse(d, mask)) return;
  hn::StoreU(hn::Add(hn::LoadU(d, place), hn::IfThenElseZero(mask, weight)), d, place);
}

template <std::size_t lanes, class Number>
void add_boxes_by(std::span<const EdgeSetup> setups, PaddedImage<Number>& layers) {
  using D = hn::CappedTag<Number, lanes>;
  const D d;
  const auto vector = static_cast<std::int32_t>(hn::Lanes(d));
  constexpr auto group = static_cast<std::int32_t>(lanes);
  for (const EdgeSetup& s : setups) {
    const Edges<D> edges(s);
    const auto weight = hn::Set(d, static_cast<Number>(s.weight()));
    const auto columns = hn::Set(d, static_cast<Number>(s.columns));
    for (std::int32_t y = 0; y < s.rows; ++y) {
      const auto row0 = Edges<D>::at_row(s, 0, y), row1 = Edges<D>::at_row(s, 1, y),
                 row2 = Edges<D>::at_row(s, 2, y);
      Number* const row = layers.row(s.image_row(y)) + s.first_column;
      for (std::int32_t begin = 0; begin < s.columns; begin += group) {
        for (std::int32_t i = begin; i < begin + group; i += vector) {
          const auto x = fast::HWY_NAMESPACE::counting_lanes(d, static_cast<Number>(i));
          const auto covered = hn::And(edges.cover(row0, row1, row2, x), hn::Lt(x, columns));
          add_where(d, covered, weight, row + i);
        }
      }
    }
  }
}

template <class Number>
void add_boxes_with(std::span<const EdgeSetup> setups, int lanes, PaddedImage<Number>& layers) {
  switch (lanes) {
    case 2:
      return add_boxes_by<2>(setups, layers);
    case 4:
      return add_boxes_by<4>(setups, layers);
    case 8:
      return add_boxes_by<8>(setups, layers);
    default:
      return add_boxes_by<16>(setups, layers);
  }
}

void add_boxes_binary32(std::span<const EdgeSetup> setups, int lanes, PaddedImage<float>& layers) {
  add_boxes_with(setups, lanes, layers);
}
void add_boxes_binary64(std::span<const EdgeSetup> setups, int lanes, PaddedImage<double>& layers) {
  add_boxes_with(setups, lanes, layers);
}

BlockCounts add_blocks_by_8(std::span<const EdgeSetup> setups, PaddedImage<double>& layers) {
  using D = hn::CappedTag<double, 8>;
  const D d;
  const auto vector = static_cast<std::int32_t>(hn::Lanes(d));
  BlockCounts counts;
  for (const EdgeSetup& s : setups) {
    const Edges<D> edges(s);
    const auto weight = hn::Set(d, static_cast<double>(s.weight()));
    for_each_block(s, [&](const PixelBlock& b) HWY_ATTR {
      counts.add(b);
      if (b.is_outside) return;
      const auto end = hn::Set(d, b.right + 1.0);
      for (std::int32_t y = b.top; y <= b.bottom; ++y) {
        double* const row = layers.row(s.image_row(y)) + s.first_column;
        const auto row0 = Edges<D>::at_row(s, 0, y), row1 = Edges<D>::at_row(s, 1, y),
                   row2 = Edges<D>::at_row(s, 2, y);
        for (std::int32_t i = b.left; i <= b.right; i += vector) {
          const auto x = fast::HWY_NAMESPACE::counting_lanes(d, static_cast<double>(i));
          auto covered = hn::Lt(x, end);
          if (!b.is_inside) covered = hn::And(covered, edges.cover(row0, row1, row2, x));
          add_where(d, covered, weight, row + i);
        }
      }
    });
  }
  return counts;
}

void draw_one(const EdgeSetup& s, DepthImage& image) {
  using D = hn::CappedTag<double, 8>;
  const D d;
  const auto vector = static_cast<std::int32_t>(hn::Lanes(d));
  // The part of the box that lies in this image, by column and row of the box.
  const auto to_column = static_cast<std::int32_t>(image.first_column) - s.first_column;
  const auto to_row = static_cast<std::int32_t>(image.first_row) - s.first_row;
  const std::int32_t left = std::max(to_column, 0), top = std::max(to_row, 0);
  const auto right = std::min(to_column + static_cast<std::int32_t>(image.depths.width), s.columns);
  const auto bottom = std::min(to_row + static_cast<std::int32_t>(image.depths.height), s.rows);
  const Edges<D> edges(s);
  const auto number = hn::Set(d, s.number + 1.0), end = hn::Set(d, static_cast<double>(right)),
             depth_right = hn::Set(d, s.depth_right);
  for (std::int32_t y = top; y < bottom; ++y) {
    const auto row0 = Edges<D>::at_row(s, 0, y), row1 = Edges<D>::at_row(s, 1, y),
               row2 = Edges<D>::at_row(s, 2, y),
               depth_of_row = hn::Set(d, s.depth + s.depth_down * y);
    double* const depths = image.depths.row(static_cast<std::size_t>(y - to_row));
    double* const numbers = image.numbers.row(static_cast<std::size_t>(y - to_row));
    for (std::int32_t i = left; i < right; i += vector) {
      const auto x = fast::HWY_NAMESPACE::counting_lanes(d, static_cast<double>(i));
      auto wins = hn::And(edges.cover(row0, row1, row2, x), hn::Lt(x, end));
      if (hn::AllFalse(d, wins)) continue;
      const auto depth = hn::Add(depth_of_row, hn::Mul(depth_right, x));
      const std::int32_t place = i - to_column;
      const auto stored = hn::LoadU(d, depths + place);
      wins = hn::And(wins, hn::Lt(depth, stored));
      if (hn::AllFalse(d, wins)) continue;
      hn::StoreU(hn::IfThenElse(wins, depth, stored), d, depths + place);
      hn::StoreU(hn::IfThenElse(wins, number, hn::LoadU(d, numbers + place)), d, numbers + place);
    }
  }
}

void draw_some(std::span<const EdgeSetup> setups, std::span<const std::uint32_t> which,
               DepthImage& image) {
  for (const std::uint32_t i : which) draw_one(setups[i], image);
}
void draw_all(std::span<const EdgeSetup> setups, DepthImage& image) {
  for (const EdgeSetup& s : setups) draw_one(s, image);
}

int binary32_lanes() {
  return static_cast<int>(hn::Lanes(hn::CappedTag<float, 16>()));
}
int binary64_lanes() {
  return static_cast<int>(hn::Lanes(hn::CappedTag<double, 16>()));
}

}  // namespace
}  // namespace fathom::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::bench {

HWY_EXPORT(add_boxes_binary32);
HWY_EXPORT(add_boxes_binary64);
HWY_EXPORT(add_blocks_by_8);
HWY_EXPORT(draw_some);
HWY_EXPORT(draw_all);
HWY_EXPORT(binary32_lanes);
HWY_EXPORT(binary64_lanes);

template <>
int lanes_of_a_vector<float>() {
  return HWY_DYNAMIC_DISPATCH(binary32_lanes)();
}
template <>
int lanes_of_a_vector<double>() {
  return HWY_DYNAMIC_DISPATCH(binary64_lanes)();
}

template <>
void add_boxes(std::span<const EdgeSetup> setups, int lanes, PaddedImage<float>& layers) {
  HWY_DYNAMIC_DISPATCH(add_boxes_binary32)(setups, lanes, layers);
}
template <>
void add_boxes(std::span<const EdgeSetup> setups, int lanes, PaddedImage<double>& layers) {
  HWY_DYNAMIC_DISPATCH(add_boxes_binary64)(setups, lanes, layers);
}

BlockCounts add_blocks(std::span<const EdgeSetup> setups, PaddedImage<double>& layers) {
  return HWY_DYNAMIC_DISPATCH(add_blocks_by_8)(setups, layers);
}

void DepthImage::clear(std::uint32_t column, std::uint32_t row) {
  first_column = column;
  first_row = row;
  std::fill(depths.numbers.begin(), depths.numbers.end(), 1.0);
  std::fill(numbers.numbers.begin(), numbers.numbers.end(), 0.0);
}

void draw_nearest(std::span<const EdgeSetup> setups, std::span<const std::uint32_t> which,
                  DepthImage& image) {
  HWY_DYNAMIC_DISPATCH(draw_some)(setups, which, image);
}

void draw_nearest(std::span<const EdgeSetup> setups, DepthImage& image) {
  HWY_DYNAMIC_DISPATCH(draw_all)(setups, image);
}

}  // namespace fathom::bench
#endif
