#pragma once

#include <fmt/format.h>

#include <type_traits>

#include "fathom/numeric/errors.h"
#include "fathom/pipeline/scan/arithmetic.h"

/// What one case may cost: a line of input is answered in seconds, or refused before the work.
namespace fathom::app::scan {

/// Steps, crossings, tests: what an algorithm does for each pixel, row or corner. Exact numbers
/// take about a microsecond for one.
template <class Number>
inline constexpr double most_operations =
    std::is_same_v<Number, pipeline::Exact> ? 1 << 22 : 1 << 26;

/// Refuses a case that takes `count` operations, which are `what`; `advice` says what limits them.
template <class Number>
void check_effort(double count, const char* what, const char* advice) {
  if (count <= most_operations<Number>) return;
  throw InputError(
      fmt::format("{:.0f} {}, more than {:.0f}; {}", count, what, most_operations<Number>, advice));
}

inline constexpr const char* window_limits_it = "\"width\" and \"height\" limit them";

}  // namespace fathom::app::scan
