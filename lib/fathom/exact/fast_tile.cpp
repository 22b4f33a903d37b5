#include "fathom/exact/fast_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fathom {
namespace {

constexpr std::uint32_t block_size = 8;

ImagePoint centre_of_pixel(std::uint32_t column, std::uint32_t row) {
  return {column + 0.5, row + 0.5};
}

double local(std::uint32_t position, std::uint32_t origin) {
  return static_cast<double>(static_cast<std::int32_t>(position - origin));
}

/// A triangle's functions along one row of samples, as functions of the local column.
struct Row {
  double e0, e1, e2, q;
  double a0, a1, a2, qa;

  Row(const TriangleSetup& t, std::uint32_t row)
      : a0(t.edge_a[0]), a1(t.edge_a[1]), a2(t.edge_a[2]), qa(t.q_a) {
    const double y = local(row, t.row);
    e0 = t.edge_c[0] + t.edge_b[0] * y;
    e1 = t.edge_c[1] + t.edge_b[1] * y;
    e2 = t.edge_c[2] + t.edge_b[2] * y;
    q = t.q_c + t.q_b * y;
  }

  [[nodiscard]] double least_edge(double x) const {
    const double f0 = e0 + a0 * x, f1 = e1 + a1 * x, f2 = e2 + a2 * x;
    const double least = f0 < f1 ? f0 : f1;
    return least < f2 ? least : f2;
  }
  [[nodiscard]] double q_at(double x) const { return q + qa * x; }
};

/// Whether the triangle certainly covers no sample of the box: an edge function is certainly
/// negative at the corner where it is greatest, and so everywhere in the box.
bool certainly_misses(const TriangleSetup& t, const PixelBox& box) {
  const double left = local(box.first_column, t.column), right = local(box.last_column, t.column);
  const double top = local(box.first_row, t.row), bottom = local(box.last_row, t.row);
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = t.edge_a[i] > 0 ? right : left;
    const double y = t.edge_b[i] > 0 ? bottom : top;
    if ((t.edge_c[i] + t.edge_b[i] * y) + t.edge_a[i] * x < -t.edge_error) return true;
  }
  return false;
}

std::uint64_t sample_count(const PixelBox& box) {
  return static_cast<std::uint64_t>(box.last_column - box.first_column + 1) *
         (box.last_row - box.first_row + 1);
}

}  // namespace

void Tile::start(const PixelBox& area) {
  area_ = area;
  q_.fill(-std::numeric_limits<double>::infinity());
  error_.fill(0);
  number_.fill(no_surface);
}

void Tile::draw(const TriangleSetup& setup, const PixelBox& box, bool test_range,
                const Context& context) {
  if (test_range) {
    draw_box<true>(setup, box, context);
  } else {
    draw_box<false>(setup, box, context);
  }
}

/// Small boxes whole, others in blocks, those without a covered sample left out.
template <bool test_range>
void Tile::draw_box(const TriangleSetup& setup, const PixelBox& box, const Context& context) {
  if (box.last_column - box.first_column < block_size &&
      box.last_row - box.first_row < block_size) {
    draw_block<test_range>(setup, box, context);
    return;
  }
  for (std::uint32_t row = box.first_row; row <= box.last_row; row += block_size) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; column += block_size) {
      const PixelBox block{column, std::min(column + block_size - 1, box.last_column), row,
                           std::min(row + block_size - 1, box.last_row)};
      if (!certainly_misses(setup, block)) draw_block<test_range>(setup, block, context);
    }
  }
}

// At every sample one of three is certain, or none: the triangle is the nearest surface so far
// ("wins"), it is not ("loses"), or neither is known. The third is settled exactly.
//
// d is the difference of two values of q with a relative error of u; the sum of their errors has
// one too, and both errors leave out 2⁻²⁰ of themselves: d > sum implies that the exact q of this
// triangle is greater. Where the triangle does not cover the sample the bound of q does not hold,
// but then "loses" is right anyway. Ends of the range are compared with q moved by twice its error:
// a bound of q is never below u·|q|, so that the second half covers the rounding of the end.
//
// `box` is at most block_size wide. Edge functions are computed for a whole row of a block, those
// beyond the box for nothing, so that the loop over them becomes vector instructions.
template <bool test_range>
void Tile::draw_block(const TriangleSetup& setup, const PixelBox& box, const Context& context) {
  const double edge_error = setup.edge_error;
  const double q_error = setup.q_error;
  const auto first = static_cast<std::int32_t>(box.first_column - setup.column);
  const std::uint32_t count = box.last_column - box.first_column + 1;
  std::uint64_t covered = 0;
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    const Row functions(setup, row);
    std::array<double, block_size> least_edge;
    for (std::size_t k = 0; k < block_size; ++k) {
      least_edge[k] = functions.least_edge(first + static_cast<std::int32_t>(k));
    }
    const std::size_t start = index(box.first_column, row);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (least_edge[k] < -edge_error) continue;
      const std::size_t i = start + k;
      const double q = functions.q_at(first + static_cast<std::int32_t>(k));
      const double d = q - q_[i];
      const double sum = q_error + error_[i];
      if (d < -sum) continue;
      bool wins = least_edge[k] > edge_error && d > sum;
      if constexpr (test_range) {
        wins = wins && context.range.certainly_contains(q - 2 * q_error, q + 2 * q_error);
      }
      if (!wins) {
        settle(setup, box.first_column + k, row, test_range, context);
        continue;
      }
      ++covered;
      q_[i] = q;
      error_[i] = setup.q_error;
      number_[i] = setup.number;
    }
  }
  context.statistics.samples_tested += sample_count(box);
  context.statistics.samples_covered += covered;
}

/// One sample, with every decision in its own tier.
void Tile::settle(const TriangleSetup& setup, std::uint32_t column, std::uint32_t row,
                  bool test_range, const Context& context) {
  const std::size_t i = index(column, row);
  const Row functions(setup, row);
  const double x = local(column, setup.column);
  const double least_edge = functions.least_edge(x);
  const double q = functions.q_at(x);
  const double d = q - q_[i];
  const double sum = static_cast<double>(setup.q_error) + error_[i];
  RenderStatistics& statistics = context.statistics;
  const ImagePoint s = centre_of_pixel(column, row);
  if (!(least_edge > setup.edge_error)) {
    ++statistics.edges.exact;
    TierCounts within;
    if (!context.referee.covers(setup.number, s, within)) return;
  }
  if (test_range) {
    const double error = 2 * static_cast<double>(setup.q_error);
    if (context.range.certainly_misses(q - error, q + error)) return;
    if (!context.range.certainly_contains(q - error, q + error)) {
      ++statistics.range.exact;
      if (!context.referee.is_in_range(setup.number, s)) return;
    }
  }
  ++statistics.samples_covered;
  const bool certainly_nearer = number_[i] == no_surface || d > sum;
  if (!certainly_nearer &&
      !context.referee.hides(setup.number, number_[i], s, context.statistics)) {
    return;
  }
  q_[i] = q;
  error_[i] = setup.q_error;
  number_[i] = setup.number;
}

namespace {

/// D rounded to binary32 if the bound settles it. Both ends of an interval that contains D round to
/// the same number, and rounding is monotone. Each end is rounded three times at most (the sum, the
/// quotient, the product), which 2⁻⁵⁰ = 8u covers, and leaves the error's room of 2⁻²⁰ over.
std::optional<float> rounded_depth(double q, double error, bool perspective) {
  const double nearest = perspective ? 1 / (q + error) : -q - error;
  const double farthest = perspective ? 1 / (q - error) : -q + error;
  if (!(nearest > 0) || !(farthest > 0)) return std::nullopt;
  const auto from = static_cast<float>(nearest * (1 - 0x1p-50));
  const auto to = static_cast<float>(farthest * (1 + 0x1p-50));
  if (from != to) return std::nullopt;
  return from;
}

}  // namespace

std::optional<EncodingFault> Tile::resolve(ChannelWriter& writer, std::uint32_t image_width,
                                           const Context& context) const {
  const bool all_exact = !writer.takes_rounded_depths();
  RenderStatistics& statistics = context.statistics;
  for (std::uint32_t row = area_.first_row; row <= area_.last_row; ++row) {
    for (std::uint32_t column = area_.first_column; column <= area_.last_column; ++column) {
      const std::size_t i = index(column, row);
      if (number_[i] == no_surface) continue;
      ++statistics.pixels_with_surface;
      const std::size_t pixel = static_cast<std::size_t>(row) * image_width + column;
      if (!all_exact) {
        if (const auto depth = rounded_depth(q_[i], error_[i], context.perspective)) {
          ++statistics.rounding.interval;
          writer.write(pixel, number_[i], *depth);
          continue;
        }
      }
      ++statistics.rounding.exact;
      if (auto fault = writer.write(pixel, context.referee.projected(number_[i]),
                                    centre_of_pixel(column, row))) {
        return fault;
      }
    }
  }
  return std::nullopt;
}

}  // namespace fathom
