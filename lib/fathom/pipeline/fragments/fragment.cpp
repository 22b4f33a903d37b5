#include "fathom/pipeline/fragments/fragment.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fathom/pipeline/scan/arithmetic.h"

namespace fathom::pipeline {
namespace {

template <class Real>
Real blend(const std::array<Real, 3>& weights, Real a, Real b, Real c) {
  return weights[0] * a + weights[1] * b + weights[2] * c;
}

}  // namespace

template <class Real>
std::optional<Interpolator<Real>> Interpolator<Real>::of(const WindowTriangle<Real>& triangle,
                                                         const PipelineOptions& options) {
  const auto grid = GridTriangle::of(snapped(triangle, options.subpixel_bits));
  if (!grid) return std::nullopt;
  return Interpolator(triangle, *grid, options.interpolation == Interpolation::perspective);
}

template <class Real>
std::array<Real, 3> Interpolator<Real>::linear_weights(const GridPoint& sample) const {
  const auto edges = grid_.edges_at(sample);
  const auto area = static_cast<Real>(grid_.twice_area());
  return {static_cast<Real>(edges[0]) / area, static_cast<Real>(edges[1]) / area,
          static_cast<Real>(edges[2]) / area};
}

template <class Real>
std::array<Real, 3> Interpolator<Real>::over_w(const std::array<Real, 3>& linear) const {
  const auto& c = triangle_->corners;
  const std::array<Real, 3> weights{linear[0] * c[0].inverse_w, linear[1] * c[1].inverse_w,
                                    linear[2] * c[2].inverse_w};
  const Real sum = weights[0] + weights[1] + weights[2];
  return {weights[0] / sum, weights[1] / sum, weights[2] / sum};
}

template <class Real>
std::array<Real, 3> Interpolator<Real>::attribute_weights(const GridPoint& sample) const {
  const auto linear = linear_weights(sample);
  return perspective_ ? over_w(linear) : linear;
}

template <class Real>
Fragment Interpolator<Real>::depths_at(const GridPoint& sample) const {
  const auto linear = linear_weights(sample);
  const auto& c = triangle_->corners;
  Fragment fragment;
  const Real z = blend(linear, c[0].z, c[1].z, c[2].z) + triangle_->depth_offset;
  fragment.window_z = std::clamp(static_cast<double>(z), 0.0, 1.0);
  constexpr std::size_t D = attribute::depth;
  fragment.depth = static_cast<double>(
      blend(over_w(linear), c[0].attributes[D], c[1].attributes[D], c[2].attributes[D]));
  return fragment;
}

template <class Real>
void Interpolator<Real>::complete(Fragment& fragment, const GridPoint& sample) const {
  const auto& c = triangle_->corners;
  const auto weights = attribute_weights(sample);
  const auto at = [&](const std::array<Real, 3>& w, std::size_t i) {
    return static_cast<double>(
        blend(w, c[0].attributes[i], c[1].attributes[i], c[2].attributes[i]));
  };
  for (std::size_t i = 0; i < attribute::of_fragments; ++i) fragment.attributes[i] = at(weights, i);
  const auto right = attribute_weights({sample.x + grid_one, sample.y});
  const auto below = attribute_weights({sample.x, sample.y + grid_one});
  for (std::size_t k = 0; k < 2; ++k) {
    fragment.duv_dx[k] = at(right, attribute::uv + k) - fragment.attributes[attribute::uv + k];
    fragment.duv_dy[k] = at(below, attribute::uv + k) - fragment.attributes[attribute::uv + k];
  }
}

template class Interpolator<float>;
template class Interpolator<double>;

namespace {

/// The integer nearest to z·(2ⁿ − 1), ties to even: the product is exact in 128 bits.
std::uint64_t unorm_code(double z, int bits) {
  int exponent = 0;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(z, &exponent), 53));
  const int shift = 53 - exponent;  // z = significand / 2^shift
  if (shift > 120) return 0;        // z < 2⁻⁶⁶
  const Int128 product = Int128{significand} * ((std::int64_t{1} << bits) - 1);
  const Int128 below = product >> shift, rest = product - (below << shift);
  const Int128 half = Int128{1} << (shift - 1);
  const bool up = rest > half || (rest == half && (below & 1) != 0);
  return static_cast<std::uint64_t>(below + (up ? 1 : 0));
}

template <class Real>
double mapped(const DepthFormat& f, Real depth) {
  const auto near = static_cast<Real>(f.near), far = static_cast<Real>(f.far);
  const auto c = static_cast<Real>(f.c), one = Real(1);
  Real z = 0;
  switch (f.mapping) {
    case Mapping::linear:
      z = (depth - near) / (far - near);
      break;
    case Mapping::w:
      z = depth / far;
      break;
    case Mapping::log:
      z = std::log(one + c * depth) / std::log(one + c * far);
      break;
    default:
      z = std::log(depth / near) / std::log(far / near);
      break;
  }
  return std::clamp(static_cast<double>(z), 0.0, 1.0);
}

}  // namespace

StoredDepth store(Storage storage, double z) {
  if (z <= 0) return {0};
  if (is_unorm(storage)) return {unorm_code(z, bits_of(storage))};
  if (storage == Storage::float32) return {std::bit_cast<std::uint32_t>(static_cast<float>(z))};
  if (storage == Storage::float64) return {std::bit_cast<std::uint64_t>(z)};
  return round_to_storage(storage, Real(Ratio(Dyadic(z))));
}

DepthTest::DepthTest(const PipelineOptions& options)
    : format_(options.depth_format),
      binary32_(options.precision == Precision::binary32),
      greater_is_nearer_(is_reversed(format_.mapping) !=
                         (options.depth_range[0] > options.depth_range[1])) {}

StoredDepth DepthTest::stored(const Fragment& fragment) const {
  if (!is_per_fragment(format_.mapping)) return store(format_.storage, fragment.window_z);
  return store(format_.storage, binary32_ ? mapped(format_, static_cast<float>(fragment.depth))
                                          : mapped(format_, fragment.depth));
}

}  // namespace fathom::pipeline
