#pragma once

#include <type_traits>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/cases/case_reading.h"

/// What `fathom clip` does with one case: a case in, the answer without its name out.
/// Number is the kernel's: double or clipping::Rational.
/// Fails    InputError: the case cannot be done.
namespace fathom::app::clip {

using namespace cases;

/// What to do where a case takes too many operations.
template <class Number>
inline constexpr const char* clip_less =
    std::is_same_v<Number, double> ? "clip it in parts"
                                   : "--kernel double does more, or clip it in parts";

/// {"segment", "window"}
template <class Number>
Json cohen_sutherland(const Json& object, Form form);
template <class Number>
Json liang_barsky(const Json& object, Form form);

/// {"subject", "clip", "op"}
template <class Number>
Json weiler_atherton(const Json& object, Form form);
/// The same by CGAL's Boolean set operations, which are exact and show no trace.
Json cgal(const Json& object, Form form);
/// {"subject", "clip", "decompose"} or {"polygon3", "planes"}
template <class Number>
Json sutherland_hodgman(const Json& object, Form form);

/// {"polygon", "volume", "attributes"} or {"segment", "volume"}, both with "hourglass" or
/// "after_division"
template <class Number>
Json homogeneous(const Json& object, Form form);

/// {"plane", "points"}, {"plane", "line"} or {"polygon3", "planes"}; {"triangle", "eye"} in place
/// of "plane"
template <class Number>
Json plane(const Json& object, Form form);

/// {"polygon3", "planes", "attributes"}, which two algorithms take; `algorithm` names the one
/// asked.
template <class Number>
Json clip_in_space(const Json& object, const std::string& algorithm, Form form);

/// The parameters of Liang and Barsky; `edges` are the names of the boundaries.
template <class Trace>
Json parameters_to_json(const Trace& trace, const char* const* edges, Form form) {
  constexpr const char* kinds[] = {"entering", "leaving", "parallel, inside", "parallel, outside"};
  Json parameters = Json::array();
  for (const auto& [k, p, q, t, crossing] : trace.parameters) {
    const auto kind = static_cast<std::size_t>(crossing);
    Json parameter{{"edge", edges[k - 1]}, {"p", to_json(p, form)}, {"q", to_json(q, form)}};
    if (kind < 2) parameter["t"] = to_json(t, form);
    parameter["kind"] = kinds[kind];
    parameters.push_back(parameter);
  }
  return {{"parameters", parameters},
          {"t_entering", to_json(trace.t_entering, form)},
          {"t_leaving", to_json(trace.t_leaving, form)}};
}

}  // namespace fathom::app::clip
