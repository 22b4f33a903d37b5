#include "fathom/lens/turn_direction.h"

#include <utility>

#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"

namespace fathom::lens {
namespace {

/// cos(2π·part/turn) from the nearest quarter of a turn: a cosine or a sine of at most 45°, whose
/// relative precision does not suffer where it is small.
BigInterval cosine(const Dyadic& part, const Dyadic& turn, long bits) {
  const Dyadic eighth = turn.scaled(-3), quarter = turn.scaled(-2);
  Dyadic rest = without_whole_turns(part + eighth, turn);
  int quarters = 0;
  for (; rest >= quarter; ++quarters) rest -= quarter;
  rest -= eighth;
  const BigInterval angle =
      BigInterval::pi(bits) * BigInterval(abs(rest).scaled(1), bits) / BigInterval(turn, bits);
  const bool is_below = rest.sign() == Sign::negative;
  switch (quarters) {
    case 0:
      return cos(angle);
    case 1:
      return is_below ? angle * sinc(angle) : -(angle * sinc(angle));
    case 2:
      return -cos(angle);
    default:
      return is_below ? -(angle * sinc(angle)) : angle * sinc(angle);
  }
}

}  // namespace

// α = a/c and β = b/2c in turns, sin x = cos(x − ¼ turn): with the turn 4c all parts are dyadic.
TurnDirection TurnDirection::equirectangular(const DistortedPoint& sample) {
  const Dyadic alpha = sample.a.scaled(2), beta = sample.b.scaled(1), quarter = sample.c;
  return {{Component{1.0, alpha - quarter, beta}, Component{1.0, beta - quarter, 0.0},
           Component{1.0, alpha, beta}},
          quarter.scaled(2),
          1.0};
}

TurnDirection TurnDirection::cylindrical(const DistortedPoint& sample) {
  const Dyadic alpha = sample.a.scaled(2), quarter = sample.c;
  return {{Component{sample.c, alpha - quarter, 0.0}, Component{sample.b, 0.0, 0.0},
           Component{sample.c, alpha, 0.0}},
          quarter.scaled(2),
          sample.c};
}

TurnDirection::TurnDirection(std::array<Component, 3> components, Dyadic turn, Dyadic scale)
    : components_(std::move(components)), turn_(std::move(turn)), scale_(std::move(scale)) {
  const std::array<DyadicInterval, 3> d = enclosure(bits_of_box);
  for (std::size_t k = 0; k < 3; ++k) box_[k] = enclose(d[k]);
}

std::array<DyadicInterval, 3> TurnDirection::enclosure(long bits) const {
  const long precision = bits + bits_to_lose;
  const auto enclosed = [&](const Component& component) {
    const auto& [factor, first, second] = component;
    return (BigInterval(factor, precision) * cosine(first, turn_, precision) *
            cosine(second, turn_, precision) / BigInterval(scale_, precision))
        .ends();
  };
  return {enclosed(components_[0]), enclosed(components_[1]), enclosed(components_[2])};
}

Waves TurnDirection::waves_of(std::size_t component) const {
  const auto& [factor, first, second] = components_[component];
  return product(Waves{{factor, first}}, Waves{{1.0, second}});
}

Waves TurnDirection::waves_at(const ExactVector3& form) const {
  Waves sum;
  for (std::size_t k = 0; k < 3; ++k) sum += form[k] * waves_of(k);
  return sum;
}

Waves TurnDirection::waves_at(const QuadraticForm& form) const {
  const Waves x = waves_of(0), y = waves_of(1), z = waves_of(2);
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  Waves sum = xx * product(x, x);
  sum += yy * product(y, y);
  sum += zz * product(z, z);
  sum += xy * product(x, y);
  sum += xz * product(x, z);
  sum += yz * product(y, z);
  return sum;
}

template <class Form>
Sign TurnDirection::sign_of_form(const Form& form) const {
  for (long bits = first_bits;; bits *= 2) {
    const auto number = [bits](const auto& x) { return BigInterval(x, bits); };
    const Sign sign =
        form_at(converted(coefficients_of(form), number), converted(enclosure(bits), number))
            .sign();
    if (sign != Sign::zero) return sign;
    if (bits == first_bits && is_zero(waves_at(form), turn_)) return Sign::zero;
  }
}

Sign TurnDirection::sign_of(const ExactVector3& form) const {
  return sign_of_form(form);
}

Sign TurnDirection::sign_of(const QuadraticForm& form) const {
  return sign_of_form(form);
}

}  // namespace fathom::lens
