#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

/// Answers to cases: their cost, and their JSON.
namespace fathom::app::cases {

// A line of input is answered in seconds, or refused before the work.

/// Steps, crossings, tests: what an algorithm does for each pixel, row or corner. Exact numbers
/// take about a microsecond for one.
template <class Number>
inline constexpr double most_operations =
    std::is_same_v<Number, clipping::Rational> ? 1 << 22 : 1 << 26;

/// Refuses a case that takes too many operations. `what` names the operations, and `advice` how to
/// limit them.
template <class Number>
void check_effort(double count, const char* what, const char* advice) {
  if (count <= most_operations<Number>) return;
  throw InputError(
      fmt::format("{:.0f} {}, more than {:.0f}; {}", count, what, most_operations<Number>, advice));
}

// Writing the answers to cases.

using Json = nlohmann::ordered_json;

struct Form {
  /// Numbers as "p/q" instead of rounded once to binary64.
  bool exact = false;
  bool trace = false;
};

inline Json to_json(double x, Form form) {
  check_interruption();
  if (!std::isfinite(x))
    throw InputError("a result is too large; exact arithmetic with --exact writes any number");
  if (form.exact) return clipping::to_fraction(clipping::Rational(x));
  return x + 0.0;  // no −0
}

inline Json to_json(const clipping::Rational& x, Form form) {
  check_interruption();
  return form.exact ? Json(clipping::to_fraction(x)) : to_json(clipping::to_binary64(x), form);
}

template <class Number>
Json to_json(const clipping::Point2<Number>& p, Form form) {
  return Json::array({to_json(p.x, form), to_json(p.y, form)});
}

template <class Number>
Json to_json(const clipping::Point3<Number>& p, Form form) {
  return Json::array({to_json(p.x, form), to_json(p.y, form), to_json(p.z, form)});
}

template <class Number>
Json to_json(const clipping::Point4<Number>& p, Form form) {
  return Json::array(
      {to_json(p.x, form), to_json(p.y, form), to_json(p.z, form), to_json(p.w, form)});
}

template <class Item>
Json to_json(const std::vector<Item>& items, Form form) {
  Json result = Json::array();
  for (const Item& item : items) result.push_back(to_json(item, form));
  return result;
}

}  // namespace fathom::app::cases
