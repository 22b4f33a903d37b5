// fathom scan: triangles by edge functions.

#include <fmt/format.h>

#include <algorithm>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/pipeline/scan/edge_function.h"

namespace fathom::app::scan {
namespace {

Json box_of(const pipeline::PixelWindow& box) {
  return {{"x_begin", box.x_begin},
          {"x_end", std::max(box.x_end, box.x_begin)},
          {"y_begin", box.y_begin},
          {"y_end", std::max(box.y_end, box.y_begin)}};
}

template <class Number>
Json trace_of(const std::optional<pipeline::EdgeTriangle<Number>>& triangle,
              const clipping::Ring<double>& corners, const pipeline::PixelWindow& box,
              const Form& form) {
  Json list = Json::array();
  for (const auto& p : corners) list.push_back({p.x, p.y});
  Json trace{{"corners", list}, {"box", box_of(box)}};
  if (!triangle) {
    trace["degenerate"] = true;
    return trace;
  }
  trace["twice_area"] = number_to_json(triangle->twice_area, form);
  trace["winding"] = triangle->turned ? "clockwise" : "counter-clockwise";
  Json edges = Json::array();
  constexpr const char* names[] = {"BC", "CA", "AB"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& e = triangle->edges[k];
    const Number zero(0);
    edges.push_back({{"edge", names[k]},
                     {"a", number_to_json(e.a, form)},
                     {"b", number_to_json(e.b, form)},
                     {"c", number_to_json(e.c, form)},
                     {"kind", e.a > zero      ? "left"
                              : e.left_or_top ? "top"
                              : e.a < zero    ? "right"
                                              : "bottom"}});
  }
  trace["edges"] = edges;
  return trace;
}

/// How many centres are tested.
double pixels_in_box(const clipping::Ring<double>& t, const pipeline::PixelWindow& window) {
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto overlap = [](double begin, double end, std::int64_t from, std::int64_t to) {
    return std::max(
        0.0, std::min(end, static_cast<double>(to)) - std::max(begin, static_cast<double>(from)));
  };
  return overlap(left, right, window.x_begin, window.x_end) *
         overlap(top, bottom, window.y_begin, window.y_end);
}

/// How much a sample of a trace takes, in pixels.
constexpr std::int64_t entries_of_a_sample = 16;
constexpr std::int64_t entries_of_a_rejected_sample = 8;

/// The centres of the box that the triangle does not cover, with the signs of the edge functions.
template <class Number>
Json rejected_samples(const pipeline::EdgeTriangle<Number>& triangle,
                      const pipeline::PixelWindow& box, PixelList& pixels) {
  Json list = Json::array();
  for (std::int64_t y = box.y_begin; y < box.y_end; ++y) {
    for (std::int64_t x = box.x_begin; x < box.x_end; ++x) {
      bool covered = true;
      Json signs = Json::array();
      for (const auto& e : triangle.edges) {
        const Number value = e.at(pipeline::centre_of<Number>(x), pipeline::centre_of<Number>(y));
        covered = covered && e.contains(value);
        signs.push_back(clipping::sign_of(value));
      }
      if (covered) continue;
      pixels.make_room(entries_of_a_rejected_sample);
      list.push_back({{"pixel", {x, y}}, {"signs", std::move(signs)}});
    }
  }
  return list;
}

}  // namespace

template <class Number>
Json edge_function(const Json& object, const Form& form) {
  cases::expect_only(object, {"triangle", "width", "height", "attributes", "w"});
  const clipping::Ring<double> ring = triangle_of(object, form);
  const CarriedAlong carried = carried_along(object, 3);
  const pipeline::PixelWindow window = window_of(object);
  cases::check_effort<Number>(pixels_in_box(ring, window), "pixels in the triangle's box",
                              "\"width\" and \"height\" limit it, scan-line needs no box");
  std::array<pipeline::Point<Number>, 3> corners;
  std::array<std::vector<Number>, 3> attributes;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = {pipeline::number_from<Number>(ring[k].x),
                  pipeline::number_from<Number>(ring[k].y)};
    attributes[k] = prepared<Number>(carried, k);
  }
  PixelList pixels(form.runs);
  Json samples = Json::array();
  const auto visit = [&](const pipeline::CoveredPixel<Number>& covered) {
    pixels.add(covered.pixel);
    if (carried.any()) {
      pixels.make_room(static_cast<std::int64_t>(attributes[0].size()));
      std::vector<Number> value;
      for (std::size_t i = 0; i < attributes[0].size(); ++i)
        value.push_back(Number(covered.barycentric[0] * attributes[0][i] +
                               covered.barycentric[1] * attributes[1][i] +
                               covered.barycentric[2] * attributes[2][i]));
      pixels.add_values(numbers_to_json(recovered(carried, std::move(value)), form));
    }
    if (form.numbers.trace) {
      pixels.make_room(entries_of_a_sample);
      Json edges = Json::array(), weights = Json::array();
      for (std::size_t k = 0; k < 3; ++k) {
        edges.push_back(number_to_json(covered.edges[k], form));
        weights.push_back(number_to_json(covered.barycentric[k], form));
      }
      samples.push_back({{"pixel", {covered.pixel.x, covered.pixel.y}},
                         {"edges", edges},
                         {"barycentric", weights}});
    }
  };
  const pipeline::EdgeRule rule = form.edges.value_or(pipeline::EdgeRule::top_left);
  pipeline::rasterize_triangle<Number>(corners, window, visit, rule);
  Json result = pixels.json(carried.any());
  if (form.numbers.trace) {
    const auto triangle = pipeline::edge_functions(corners, rule);
    const pipeline::PixelWindow box = pipeline::bounding_box(corners, window);
    result["trace"] = trace_of(triangle, ring, box, form);
    result["trace"]["samples"] = std::move(samples);
    if (triangle) result["trace"]["rejected"] = rejected_samples(*triangle, box, pixels);
  }
  return result;
}

template Json edge_function<pipeline::Exact>(const Json&, const Form&);
template Json edge_function<double>(const Json&, const Form&);
template Json edge_function<float>(const Json&, const Form&);

}  // namespace fathom::app::scan
