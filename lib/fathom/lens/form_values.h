#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/exact_polynomial.h"

/// Values of linear and quadratic forms in any arithmetic, and precisions. Only for .cpp files of
/// this module.
namespace fathom::lens {

/// The bits of the first attempt at a sign.
inline constexpr long first_bits = 128;
/// The bits of the arithmetic of a box, and those that the sums of a direction's formula may lose.
inline constexpr long bits_of_box = 72, bits_to_lose = 16;

inline const std::array<Dyadic, 3>& coefficients_of(const ExactVector3& form) {
  return form;
}
inline const std::array<Dyadic, 6>& coefficients_of(const QuadraticForm& form) {
  return form.coefficients;
}

/// form·d
template <class T>
T form_at(const std::array<T, 3>& form, const std::array<T, 3>& d) {
  return form[0] * d[0] + form[1] * d[1] + form[2] * d[2];
}

/// The quadratic form with the coefficients of x², y², z², xy, xz and yz, at d.
template <class T>
T form_at(const std::array<T, 6>& form, const std::array<T, 3>& d) {
  const auto& [xx, yy, zz, xy, xz, yz] = form;
  return d[0] * (xx * d[0] + xy * d[1] + xz * d[2]) + d[1] * (yy * d[1] + yz * d[2]) +
         zz * d[2] * d[2];
}

template <class Number, std::size_t size, class Convert, std::size_t... i>
auto converted(const std::array<Number, size>& numbers, const Convert& convert,
               std::index_sequence<i...> /*indices*/) {
  return std::array<decltype(convert(numbers[0])), size>{convert(numbers[i])...};
}

/// The same numbers in another arithmetic.
template <class Number, std::size_t size, class Convert>
auto converted(const std::array<Number, size>& numbers, const Convert& convert) {
  return converted(numbers, convert, std::make_index_sequence<size>());
}

inline Dyadic size_of(const DyadicInterval& x) {
  return std::max(abs(x.low), abs(x.high));
}

/// Whether an enclosure of a direction is as narrow as `bits` bits of `size`; x and y, of the
/// greater of them.
inline bool is_narrow(const std::array<DyadicInterval, 3>& d, long bits, const Dyadic& size) {
  const Dyadic aside = std::max(size_of(d[0]), size_of(d[1])).scaled(-bits);
  const auto is_within = [&d](std::size_t k, const Dyadic& width) {
    return d[k].high - d[k].low <= width;
  };
  return is_within(0, aside) && is_within(1, aside) && is_within(2, size.scaled(-bits));
}

}  // namespace fathom::lens
