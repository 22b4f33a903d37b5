#pragma once

#include <fmt/format.h>

#include <type_traits>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"

/// What one case may cost: a line of input is answered in seconds, or refused before the work.
namespace fathom::app::cases {

/// Steps, crossings, tests: what an algorithm does for each pixel, row or corner. Exact numbers
/// take about a microsecond for one.
template <class Number>
inline constexpr double most_operations =
    std::is_same_v<Number, clipping::Rational> ? 1 << 22 : 1 << 26;

/// Refuses a case that takes `count` operations, which are `what`; `advice` says what limits them.
template <class Number>
void check_effort(double count, const char* what, const char* advice) {
  if (count <= most_operations<Number>) return;
  throw InputError(
      fmt::format("{:.0f} {}, more than {:.0f}; {}", count, what, most_operations<Number>, advice));
}

}  // namespace fathom::app::cases
