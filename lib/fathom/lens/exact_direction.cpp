#include "fathom/lens/exact_direction.h"

#include <utility>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {

ExactDirection::ExactDirection(RationalDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(PolynomialDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(AngleDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(OneRootDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(NestedRootDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(BentRootDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(TurnDirection direction) : direction_(std::move(direction)) {}

const std::array<Interval, 3>& ExactDirection::box() const {
  return std::visit(
      [](const auto& d) -> const auto& { return d.box(); }, direction_);
}

Sign ExactDirection::sign_of(const ExactVector3& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& d) { return d.sign_of(form); }, direction_);
}

Sign ExactDirection::sign_of(const QuadraticForm& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& d) { return d.sign_of(form); }, direction_);
}

std::array<DyadicInterval, 3> ExactDirection::enclosure(long bits) const {
  const StandardArithmetic standard;
  return std::visit([bits](const auto& d) { return d.enclosure(bits); }, direction_);
}

std::optional<DirectionWords> ExactDirection::words() const {
  const StandardArithmetic standard;
  constexpr long bits = 90;
  return std::visit(
      [](const auto& d) -> std::optional<DirectionWords> {
        if constexpr (requires { d.words(); })
          return d.words();
        else
          return words_within(d.enclosure(bits));
      },
      direction_);
}

const ExactVector3* ExactDirection::rational() const {
  const auto* const rational = std::get_if<RationalDirection>(&direction_);
  return rational == nullptr ? nullptr : &rational->vector();
}

}  // namespace fathom::lens
