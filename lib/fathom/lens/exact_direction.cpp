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

std::array<Enclosure, 3> ExactDirection::enclosure(long bits) const {
  const StandardArithmetic standard;
  return std::visit([bits](const auto& direction) { return direction.enclosure(bits); },
                    direction_);
}

}  // namespace fathom
