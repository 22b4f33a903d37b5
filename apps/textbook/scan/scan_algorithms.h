#pragma once

#include <optional>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/cases/case_reading.h"
#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/pipeline/scan/pixels.h"

/// What `fathom scan` does with one case: a case in, the answer without its name out.
/// Number is the arithmetic: pipeline::Exact, double or float.
/// Fails    InputError: the case cannot be done.
namespace fathom::app::scan {

using cases::Json;

/// What to do where a case takes too many operations.
inline constexpr const char* window_limits_it = "\"width\" and \"height\" limit them";

struct Form {
  cases::Form numbers;
  /// Runs of pixels instead of pixels.
  bool runs = false;
  std::optional<int> subpixel_bits;
  std::optional<pipeline::TieRule> ties;    ///< greater where nullopt
  std::optional<pipeline::EdgeRule> edges;  ///< top-left where nullopt
};

template <class Number>
Json explicit_line(const Json& object, const Form& form);
template <class Number>
Json dda(const Json& object, const Form& form);
template <class Number>
Json bresenham(const Json& object, const Form& form);
template <class Number>
Json midpoint(const Json& object, const Form& form);
template <class Number>
Json diamond_exit(const Json& object, const Form& form);

/// {"line", "points", "parameters"}: the explicit, implicit and parametric forms of a line.
template <class Number>
Json line_forms(const Json& object, const Form& form);

/// {"polygon", "attributes", "w"}
template <class Number>
Json even_odd(const Json& object, const Form& form);
template <class Number>
Json non_zero(const Json& object, const Form& form);
/// {"triangle", "attributes", "w"}
template <class Number>
Json edge_function(const Json& object, const Form& form);
template <class Number>
Json scan_line(const Json& object, const Form& form);

/// {"grid", "seed", "connectivity"}
Json flood(const Json& object, const Form& form);

template <class Number>
Json inside(const Json& object, const Form& form);
template <class Number>
Json convexity(const Json& object, const Form& form);
template <class Number>
Json convex_hull(const Json& object, const Form& form);
/// Exact in every arithmetic.
Json tessellate(const Json& object, const Form& form);

/// Numbers of the three arithmetics.
template <class Number>
Json number_to_json(const Number& x, const Form& form) {
  if constexpr (std::is_same_v<Number, pipeline::Exact>)
    return cases::to_json(x, form.numbers);
  else
    return cases::to_json(static_cast<double>(x), form.numbers);
}

template <class Number>
Json numbers_to_json(const std::vector<Number>& numbers, const Form& form) {
  Json list = Json::array();
  for (const Number& x : numbers) list.push_back(number_to_json(x, form));
  return list;
}

template <class Number>
Json point_to_json(const clipping::Point2<Number>& p, const Form& form) {
  return Json::array({number_to_json(p.x, form), number_to_json(p.y, form)});
}

}  // namespace fathom::app::scan
