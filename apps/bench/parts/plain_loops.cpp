#include "apps/bench/parts/edge_kernels.h"

namespace fathom::bench {
namespace {

/// The edge functions of a triangle over an arithmetic.
template <class Number>
struct PlainEdges {
  explicit PlainEdges(const EdgeSetup& s) {
    for (std::size_t k = 0; k < 3; ++k) {
      start[k] = static_cast<Number>(s.start[k]);
      right[k] = static_cast<Number>(s.right[k]);
      down[k] = static_cast<Number>(s.down[k]);
      least[k] = static_cast<Number>(s.least[k]);
    }
  }
  /// Their values at the beginning of a row.
  [[nodiscard]] std::array<Number, 3> at_row(std::int32_t y) const {
    const auto rows = static_cast<Number>(y);
    return {start[0] + down[0] * rows, start[1] + down[1] * rows, start[2] + down[2] * rows};
  }
  [[nodiscard]] bool cover(const std::array<Number, 3>& row, std::int32_t x) const {
    bool covered = true;
    for (std::size_t k = 0; k < 3; ++k)
      covered &= row[k] + right[k] * static_cast<Number>(x) >= least[k];
    return covered;
  }

  std::array<Number, 3> start, right, down, least;
};

}  // namespace

template <class Number, class Layer>
void add_boxes_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<Layer>& layers) {
  for (const EdgeSetup& s : setups) {
    const PlainEdges<Number> edges(s);
    const auto weight = static_cast<Layer>(s.weight());
    for (std::int32_t y = 0; y < s.rows; ++y) {
      const std::array<Number, 3> at_row = edges.at_row(y);
      Layer* const row = layers.row(s.image_row(y)) + s.first_column;
      for (std::int32_t x = 0; x < s.columns; ++x) {
        if (edges.cover(at_row, x)) row[x] += weight;
      }
    }
  }
}

template void add_boxes_one_by_one<float>(std::span<const EdgeSetup>, PaddedImage<float>&);
template void add_boxes_one_by_one<double>(std::span<const EdgeSetup>, PaddedImage<double>&);
template void add_boxes_one_by_one<std::int64_t>(std::span<const EdgeSetup>, PaddedImage<double>&);

BlockCounts add_blocks_one_by_one(std::span<const EdgeSetup> setups, PaddedImage<double>& layers) {
  BlockCounts counts;
  for (const EdgeSetup& s : setups) {
    const PlainEdges<double> edges(s);
    const double weight = s.weight();
    for_each_block(s, [&](const PixelBlock& b) {
      counts.add(b);
      if (b.is_outside) return;
      for (std::int32_t y = b.top; y <= b.bottom; ++y) {
        double* const row = layers.row(s.image_row(y)) + s.first_column;
        if (b.is_inside) {
          for (std::int32_t x = b.left; x <= b.right; ++x) row[x] += weight;
          continue;
        }
        const std::array<double, 3> at_row = edges.at_row(y);
        for (std::int32_t x = b.left; x <= b.right; ++x) {
          if (edges.cover(at_row, x)) row[x] += weight;
        }
      }
    });
  }
  return counts;
}

}  // namespace fathom::bench
