#include "fathom/fast/pixels/zero_proof.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/divisors.h"

namespace fathom::fast {
using namespace triangle;

namespace {

/// Not less than |n·d| at a sample: from the leading words, whose own errors are 3u of the terms.
double divisor_size(const DepthForms<WordPair>& depth, const ImagePoint& s, bool perspective) {
  if (!perspective) return std::abs(depth.constant.value.hi) * slack + depth.constant.error;
  const auto& [a, b, c, error] = depth.varying;
  const double terms = std::abs(c.hi) + std::abs(b.hi) * s.v + std::abs(a.hi) * s.u;
  return std::abs((c.hi + b.hi * s.v) + a.hi * s.u) + terms * 0x1p-50 + error;
}

}  // namespace

const std::array<long, 3>& ZeroProof::corner_bits() {
  if (!corner_bits_) {
    const auto& [A, B, C] = surface_.corners;
    corner_bits_ = {std::min({last_bit(A.x), last_bit(B.x), last_bit(C.x)}),
                    std::min({last_bit(A.y), last_bit(B.y), last_bit(C.y)}),
                    std::min({last_bit(A.z), last_bit(B.z), last_bit(C.z)})};
  }
  return *corner_bits_;
}

long ZeroProof::world_bits(std::size_t k) {
  return surface_.object->world_rows[k].last_bit_at(corner_bits());
}

long ZeroProof::image_bits(std::size_t k) {
  return surface_.object->image_rows[k].last_bit_at(corner_bits());
}

// Samples are multiples of ½.
long ZeroProof::weight_bits() {
  const long U = image_bits(0), V = image_bits(1);
  const long W = perspective_ ? image_bits(2) : 0;
  return std::min({U + V, U + W - 1, V + W - 1});
}

// 2⁻⁶⁰⁰: products that underflow on the way are below 2⁻⁷⁷⁴.
bool ZeroProof::holds(double value, double divisor, long numerator_bits) const {
  if (numerator_bits < -600) return false;
  const double bound = value * divisor * surface_.object->determinant * slack;
  return bound < std::ldexp(1.0, static_cast<int>(std::min(numerator_bits, 900L)));
}

bool ZeroProof::holds(const Certified<WordPair>& value, const DepthForms<WordPair>& depth,
                      const ImagePoint& s, long numerator_bits) const {
  return holds(std::abs(value.value.hi) + value.error, divisor_size(depth, s, perspective_),
               numerator_bits);
}

}  // namespace fathom::fast
