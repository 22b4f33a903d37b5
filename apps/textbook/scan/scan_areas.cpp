// fathom scan: polygons and triangles by scan lines.

#include <algorithm>
#include <utility>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/pipeline/scan/area_fill.h"

namespace fathom::app::scan {
namespace {

using pipeline::FillPolygon;
using pipeline::FillRule;
using pipeline::ScanLine;

template <class Number>
Json trace_of(const ScanLine<Number>& line, const Form& form) {
  Json crossings = Json::array(), spans = Json::array();
  for (const auto& c : line.crossings) {
    Json crossing{{"x", number_to_json(c.x, form)},
                  {"winding", c.winding},
                  {"dx_dy", number_to_json(c.dx_dy, form)}};
    if (!c.attributes.empty()) {
      crossing["R"] = numbers_to_json(c.attributes, form);
      crossing["dR_dy"] = numbers_to_json(c.dr_dy, form);
    }
    crossings.push_back(std::move(crossing));
  }
  for (const auto& s : line.spans) {
    Json span{{"left", number_to_json(line.crossings[s.left].x, form)},
              {"right", number_to_json(line.crossings[s.right].x, form)},
              {"x_begin", s.pixels.x_begin},
              {"x_end", std::max(s.pixels.x_end, s.pixels.x_begin)}};
    if (!s.first.empty()) {
      span["R"] = numbers_to_json(s.first, form);
      span["dR_dx"] = numbers_to_json(s.dr_dx, form);
    }
    spans.push_back(std::move(span));
  }
  return {{"y", line.y}, {"crossings", crossings}, {"spans", spans}};
}

template <class Number>
FillPolygon<Number> with_attributes(const clipping::Rings<double>& rings,
                                    const CarriedAlong& carried) {
  FillPolygon<Number> polygon;
  std::size_t corner = 0;
  for (const auto& ring : rings) {
    polygon.emplace_back();
    for (const auto& p : ring)
      polygon.back().push_back({pipeline::number_from<Number>(p.x),
                                pipeline::number_from<Number>(p.y),
                                prepared<Number>(carried, corner++)});
  }
  return polygon;
}

/// How often edges cross rows of the window.
double crossings_of(const clipping::Rings<double>& rings, const pipeline::PixelWindow& window) {
  double crossings = 0;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto [top, bottom] = std::minmax(ring[i].y, ring[(i + 1) % ring.size()].y);
      crossings += std::max(0.0, std::min(bottom + 1, static_cast<double>(window.y_end)) -
                                     std::max(top, static_cast<double>(window.y_begin)));
    }
  }
  return crossings;
}

/// How much a crossing or a span of a trace takes, in pixels.
std::int64_t entries_of(std::size_t attributes) {
  return 8 + 2 * static_cast<std::int64_t>(attributes);
}

template <class Number>
Json fill(const Json& object, const clipping::Rings<double>& rings,
          const std::vector<ClosingCorner>& closing, FillRule rule, const Form& form) {
  std::size_t corners = 0;
  for (const auto& ring : rings) corners += ring.size();
  const CarriedAlong carried = carried_along(object, corners, closing);
  const pipeline::PixelWindow window = window_of(object);
  const std::size_t attributes = carried.any() ? carried.attributes[0].size() : 0;
  cases::check_effort<Number>(crossings_of(rings, window) * static_cast<double>(1 + attributes),
                              "crossings of edges and rows", window_limits_it);
  PixelList pixels(form.runs);
  Json trace = Json::array();
  pipeline::fill_polygon<Number>(
      with_attributes<Number>(rings, carried), rule, window, [&](const ScanLine<Number>& line) {
        for (const auto& span : line.spans) {
          pixels.add(span.pixels);
          if (!carried.any() || span.pixels.x_begin >= span.pixels.x_end) continue;
          pixels.make_room((span.pixels.x_end - span.pixels.x_begin) *
                           static_cast<std::int64_t>(1 + attributes));
          for (auto& value : pipeline::values_along(span))
            pixels.add_values(numbers_to_json(recovered(carried, std::move(value)), form));
        }
        if (!form.numbers.trace) return;
        pixels.make_room(static_cast<std::int64_t>(line.crossings.size() + line.spans.size()) *
                         entries_of(attributes));
        trace.push_back(trace_of(line, form));
      });
  Json result = pixels.json(carried.any());
  if (form.numbers.trace) result["trace"] = std::move(trace);
  return result;
}

template <class Number>
Json fill_polygon(const Json& object, FillRule rule, const Form& form) {
  cases::expect_only(object, {"polygon", "width", "height", "attributes", "w"});
  std::vector<ClosingCorner> closing;
  const clipping::Rings<double> rings = polygon_of(object, &closing);
  return fill<Number>(object, rings, closing, rule, form);
}

}  // namespace

template <class Number>
Json even_odd(const Json& object, const Form& form) {
  return fill_polygon<Number>(object, FillRule::even_odd, form);
}

template <class Number>
Json non_zero(const Json& object, const Form& form) {
  return fill_polygon<Number>(object, FillRule::non_zero, form);
}

template <class Number>
Json scan_line(const Json& object, const Form& form) {
  cases::expect_only(object, {"triangle", "width", "height", "attributes", "w"});
  return fill<Number>(object, {triangle_of(object, form)}, {}, FillRule::even_odd, form);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                          \
  template Json even_odd<Number>(const Json&, const Form&); \
  template Json non_zero<Number>(const Json&, const Form&); \
  template Json scan_line<Number>(const Json&, const Form&);
FATHOM_INSTANTIATE(pipeline::Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::app::scan
