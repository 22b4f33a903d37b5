#include "fathom/depth_format/resolution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The next stored value on the side of nearer or of farther depths.
std::optional<StoredDepth> neighbour(const DepthFormat& format, StoredDepth stored, bool farther) {
  const bool up = farther != is_reversed(format.mapping);
  if (up ? stored == greatest_stored(format.storage) : stored.bits == 0) return std::nullopt;
  return StoredDepth{up ? stored.bits + 1 : stored.bits - 1};
}

std::optional<double> distance(const DepthFormat& format, StoredDepth from,
                               std::optional<StoredDepth> to, bool farther) {
  if (!to) return std::nullopt;
  const std::optional<Real> here = decode(format, from), there = decode(format, *to);
  if (!here || !there) return infinity;
  return round_to_binary64(farther ? difference(*there, *here) : difference(*here, *there));
}

/// Where the interval of depths that are stored as `stored` ends on one side, regardless of near
/// and far; nullopt if it has no end.
std::optional<Real> end_of_bin(const DepthFormat& format, StoredDepth stored, bool farther) {
  const std::optional<StoredDepth> next = neighbour(format, stored, farther);
  if (!next) return std::nullopt;
  return depth_of(format, boundary_above(format.storage, std::min(stored, *next)));
}

bool is_finite(const DepthFormat& format) {
  return !std::isinf(format.far);
}

}  // namespace

Resolution resolution(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  const StoredDepth stored = encode(format, depth);
  return {stored, distance(format, stored, neighbour(format, stored, false), false),
          distance(format, stored, neighbour(format, stored, true), true)};
}

std::uint64_t codes_between(const DepthFormat& format, const Ratio& nearest,
                            const Ratio& farthest) {
  const StandardArithmetic standard;
  const std::uint64_t a = encode(format, nearest).bits, b = encode(format, farthest).bits;
  return (a < b ? b - a : a - b) + 1;
}

std::optional<double> separation_behind(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  const std::optional<Real> end = end_of_bin(format, encode(format, depth), true);
  if (!end) return std::nullopt;
  if (is_finite(format) && compare(*end, Dyadic(format.far)) >= 0) return std::nullopt;
  return round_to_binary64(difference(*end, depth));
}

double bin_width(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  const StoredDepth stored = encode(format, depth);
  const Ratio near = Dyadic(format.near);
  std::optional<Real> begin = end_of_bin(format, stored, false);
  if (!begin || compare(*begin, near) < 0) begin = near;
  std::optional<Real> end = end_of_bin(format, stored, true);
  if (is_finite(format) && (!end || compare(*end, Dyadic(format.far)) > 0)) {
    end = Ratio(Dyadic(format.far));
  }
  if (!end) return infinity;
  return round_to_binary64(difference(*end, *begin));
}

}  // namespace fathom
