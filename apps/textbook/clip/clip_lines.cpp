// fathom clip: segments in a window.

#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/clipping/cohen_sutherland.h"
#include "fathom/clipping/liang_barsky.h"

namespace fathom::app::clip {
namespace {

using clipping::Rational;

template <class Number>
struct LineCase {
  clipping::Segment2<Number> segment;
  clipping::Window<Number> window;
};

template <class Number>
LineCase<Number> line_case(const Json& object, std::string_view algorithm) {
  expect_only(object, {"segment", "window"}, algorithm);
  const auto ends = points(object, "segment", 2, 2);
  if (ends.size() != 2) throw InputError("segment: expected two points");
  const auto w = numbers(member(object, "window"), "window", 4, 4);
  const auto point = [](const std::vector<double>& xy) {
    return clipping::Point2<Number>{Number(xy[0]), Number(xy[1])};
  };
  return {{point(ends[0]), point(ends[1])},
          {Number(w[0]), Number(w[1]), Number(w[2]), Number(w[3])}};
}

template <class Number>
Json to_json(const clipping::Segment2<Number>& s, Form form) {
  return Json::array({cases::to_json(s.start, form), cases::to_json(s.end, form)});
}

template <class Number>
Json answer(const std::optional<clipping::Segment2<Number>>& part, Form form) {
  return {{"segment", part ? to_json(*part, form) : Json(nullptr)}};
}

const char* edge_name(clipping::Outcode edge) {
  return edge == clipping::outcode::left     ? "left"
         : edge == clipping::outcode::right  ? "right"
         : edge == clipping::outcode::bottom ? "bottom"
                                             : "top";
}

template <class Number>
Json to_json(const clipping::CohenSutherlandStep<Number>& step, Form form) {
  Json result{{"segment", to_json(step.segment, form)},
              {"outcodes", {clipping::to_bits(step.E1), clipping::to_bits(step.E2)}},
              {"and", clipping::to_bits(step.E1 & step.E2)},
              {"test", step.test}};
  if (step.moved == 0) {
    result["verdict"] = step.test == 1 ? "visible" : "invisible";
  } else {
    result["verdict"] = "split";
    result["edge"] = edge_name(step.edge);
    result["moved"] = step.moved == 1 ? "E1" : "E2";
  }
  return result;
}

}  // namespace

template <class Number>
Json cohen_sutherland(const Json& object, Form form) {
  const auto [segment, window] = line_case<Number>(object, "cohen-sutherland");
  std::vector<clipping::CohenSutherlandStep<Number>> trace;
  Json result = answer(clipping::cohen_sutherland(segment, window, &trace), form);
  if (form.trace) {
    result["trace"] = Json::array();
    for (const auto& step : trace) result["trace"].push_back(to_json(step, form));
  }
  return result;
}

template <class Number>
Json liang_barsky(const Json& object, Form form) {
  constexpr const char* edges[] = {"left", "right", "bottom", "top"};
  const auto [segment, window] = line_case<Number>(object, "liang-barsky");
  clipping::LiangBarskyTrace<Number> trace;
  Json result = answer(clipping::liang_barsky(segment, window, &trace), form);
  if (form.trace) result["trace"] = parameters_to_json(trace, edges, form);
  return result;
}

template Json cohen_sutherland<double>(const Json&, Form);
template Json cohen_sutherland<Rational>(const Json&, Form);
template Json liang_barsky<double>(const Json&, Form);
template Json liang_barsky<Rational>(const Json&, Form);

}  // namespace fathom::app::clip
