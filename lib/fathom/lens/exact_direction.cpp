#include "fathom/lens/exact_direction.h"

#include <utility>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

ExactDirection::ExactDirection(RationalDirection direction)
    : box_(direction.box()), direction_(std::move(direction)) {}

Sign ExactDirection::sign(const ExactVector3& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& direction) { return direction.sign(form); }, direction_);
}

Sign ExactDirection::sign(const QuadraticForm& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& direction) { return direction.sign(form); }, direction_);
}

const ExactVector3* ExactDirection::rational() const {
  const auto* const direction = std::get_if<RationalDirection>(&direction_);
  return direction ? &direction->vector() : nullptr;
}

std::array<DyadicInterval, 3> ExactDirection::enclosure(long /*bits*/) const {
  const ExactVector3& d = *rational();
  return {DyadicInterval{d[0], d[0]}, DyadicInterval{d[1], d[1]}, DyadicInterval{d[2], d[2]}};
}

}  // namespace fathom
