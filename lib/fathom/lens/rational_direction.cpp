#include "fathom/lens/rational_direction.h"

#include <utility>

#include "fathom/numeric/big_interval.h"

namespace fathom::lens {

RationalDirection::RationalDirection(ExactVector3 vector, Dyadic scale)
    : vector_(std::move(vector)), scale_(std::move(scale)) {
  const Interval of_scale = enclose(scale_);
  for (std::size_t i = 0; i < 3; ++i) box_[i] = quotient(enclose(vector_[i]), of_scale);
}

// MPFR's least precision is 1 bit; 4 more make up for the roundings.
std::array<DyadicInterval, 3> RationalDirection::enclosure(long bits) const {
  const long precision = bits + 4;
  const BigInterval scale(scale_, precision);
  const auto component = [&](std::size_t i) {
    return (BigInterval(vector_[i], precision) / scale).ends();
  };
  return {component(0), component(1), component(2)};
}

}  // namespace fathom::lens
