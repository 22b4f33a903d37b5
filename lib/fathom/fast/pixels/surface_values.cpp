#include "fathom/fast/pixels/surface_values.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/divisors.h"

namespace fathom::fast {

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
