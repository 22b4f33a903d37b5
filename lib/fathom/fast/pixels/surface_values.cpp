#include "fathom/fast/pixels/surface_values.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/dyadic.h"

namespace fathom::fast {
using namespace triangle;

ValueFrame::ValueFrame(const SceneRays& its_rays)
    : rays(its_rays),
      wide(wide_arithmetic()),
      image{rays.perspective(), rays.greatest_u(), rays.greatest_v()},
      world_sizes(rays.world().rays, image) {}

SurfaceFacts surface_facts(std::uint32_t number, const ValueFrame& frame) {
  const TriangleSource::Triangle triangle = frame.rays.triangles().triangle(number);
  SurfaceFacts t;
  t.origin = triangle.origin;
  t.object = &frame.rays.object(t.origin.object);
  t.corners = triangle.corners;
  t.usable = t.object->usable && frame.rays.world().usable && triangle::is_safe(t.corners);
  return t;
}

const WeightForms<double>& weights_of(SurfaceFacts& t, const ValueFrame& frame) {
  if (!t.weights) t.weights = weight_forms<double>(t.corners, t.object->rays, frame.image);
  return *t.weights;
}

const DepthForms<WordPair>& depth_of(SurfaceFacts& t, const ValueFrame& frame) {
  if (!t.depth) t.depth = frame.wide.depth_forms(t.corners, t.object->rays, frame.image);
  return *t.depth;
}

const std::optional<WordPair>& constant_of(SurfaceFacts& t, std::size_t k) {
  if ((t.constants_known >> k & 1) != 0) return t.constants[k];
  t.constants_known |= static_cast<std::uint8_t>(1U << k);
  const ExactRow& row = k < 3 ? t.object->world_rows[k] : t.object->image_rows[2];
  const auto at_A = row.value_at(t.corners[0]);
  const auto is_at = [&](const MeshPoint& X) {
    const auto value = row.value_at(X);
    return value && value->hi == at_A->hi && value->lo == at_A->lo;
  };
  if (at_A && is_at(t.corners[1]) && is_at(t.corners[2])) t.constants[k] = at_A;
  return t.constants[k];
}

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

const Certified<WordPair>& SurfaceValues::depth() {
  if (!depth_) depth_ = frame_.wide.depth(depth_of(surface_, frame_), s_, frame_.image.perspective);
  return *depth_;
}

const Certified<WordPair>& SurfaceValues::position(std::size_t k) {
  if (!position_) {
    position_ = frame_.wide.position(frame_.rays.world().rays, frame_.world_sizes,
                                     frame_.image.perspective, s_, depth());
  }
  return (*position_)[k];
}

const Certified<WordPair>& SurfaceValues::weight(std::size_t k) {
  if (!weights_) {
    weights_ = frame_.wide.weights(surface_.corners, surface_.object->rays, frame_.image, s_);
  }
  return (*weights_)[k];
}

const std::optional<WordPair>& SurfaceValues::exact_depth() {
  if (looked_for_exact_depth_) return exact_depth_;
  looked_for_exact_depth_ = true;
  exact_depth_ = constant_of(surface_, 3);
  const Certified<WordPair>& D = depth();
  for (const double candidate : {static_cast<double>(static_cast<float>(D.value.hi)), D.value.hi}) {
    if (exact_depth_) break;
    const WordPair rest = two_sum(D.value.hi - candidate, D.value.lo);
    const long bits = std::min(zero_.image_bits(2), last_bit(candidate));
    if (is_zero({rest, D.error}, zero_.weight_bits() + bits)) exact_depth_ = {candidate, 0};
  }
  return exact_depth_;
}

bool SurfaceValues::position_is_zero(std::size_t k) {
  return is_zero(position(k), zero_.weight_bits() + zero_.world_bits(k));
}

bool SurfaceValues::weight_is_zero(const Certified<double>& narrow) {
  return interpolated_is_zero(narrow, 0);
}

bool SurfaceValues::interpolated_is_zero(const Certified<double>& narrow, long bits) {
  const Certified<double> divisor = weights_of(surface_, frame_).divisor.at(s_);
  return zero_.holds(std::abs(narrow.value) + narrow.error, std::abs(divisor.value) + divisor.error,
                     zero_.weight_bits() + bits);
}

bool SurfaceValues::weight_is_zero(std::size_t k) {
  return is_zero(weight(k), zero_.weight_bits());
}

bool SurfaceValues::is_zero(const Certified<WordPair>& value, long numerator_bits) {
  return zero_.holds(value, depth_of(surface_, frame_), s_, numerator_bits);
}

}  // namespace fathom::fast
