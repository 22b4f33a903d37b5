// fathom scan: lines.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/line.h"

namespace fathom::app::scan {
namespace {

using pipeline::Pixel;
using pipeline::PixelWindow;

std::vector<double> ends_of(const Json& object) {
  cases::expect_only(object, {"line", "width", "height"});
  std::vector<double> ends = cases::numbers(cases::member(object, "line"), "line", 4, 4);
  for (const double x : ends) checked_coordinate(x, "line");
  return ends;
}

pipeline::LineEnds pixel_ends_of(const Json& object, const Form& form) {
  const std::vector<double> ends = ends_of(object);
  for (const double x : ends)
    if (x != std::floor(x))
      throw InputError(fmt::format(
          "line: {} is not a whole number; ends of lines are pixels, except for diamond-exit", x));
  const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(ends[i]); };
  return {whole(0), whole(1), whole(2), whole(3), form.ties.value_or(pipeline::TieRule::greater)};
}

/// How much a step of a trace takes, in pixels.
constexpr std::int64_t entries_of_a_step = 8;

/// Draws a line by an algorithm that computes with Number; `describe` makes the trace of a step
/// from its pixel and its state.
template <class Number, class State, class Draw, class Describe>
Json draw(const Json& object, const Form& form, const Draw& draw_line, const Describe& describe) {
  const pipeline::LineEnds ends = pixel_ends_of(object, form);
  const PixelWindow window = window_of(object);
  const auto [first, last] = pipeline::LineAxes(ends).steps_in(window);
  cases::check_effort<Number>(static_cast<double>(last) - static_cast<double>(first) + 1,
                              "steps of the line", window_limits_it);
  PixelList pixels(form.runs);
  Json steps = Json::array();
  draw_line(ends, window, [&](const Pixel& pixel, const State& state) {
    pixels.add(pixel);
    if (form.numbers.trace) {
      pixels.make_room(entries_of_a_step);
      Json step{{"pixel", {pixel.x, pixel.y}}};
      step.update(describe(pixel, state));
      steps.push_back(std::move(step));
    }
  });
  Json result = pixels.json(false);
  if (form.numbers.trace)
    result["trace"] = {{"axis", pipeline::LineAxes(ends).steep ? "y" : "x"}, {"steps", steps}};
  return result;
}

bool is_steep(const std::vector<double>& ends) {
  return std::abs(ends[3] - ends[1]) > std::abs(ends[2] - ends[0]);
}

/// How many columns, or rows, of the window the line can pass through.
double columns_of(const std::vector<double>& ends, const PixelWindow& window) {
  const bool steep = is_steep(ends);
  const auto [from, to] = steep ? std::minmax(ends[1], ends[3]) : std::minmax(ends[0], ends[2]);
  const auto begin = static_cast<double>(steep ? window.y_begin : window.x_begin);
  const auto end = static_cast<double>(steep ? window.y_end : window.x_end);
  return std::max(0.0, std::min(to + 2, end) - std::max(from - 1, begin));
}

/// Of each column a few diamonds are tested.
constexpr double tests_of_a_column = 8;

}  // namespace

template <class Number>
Json explicit_line(const Json& object, const Form& form) {
  return draw<Number, Number>(object, form, pipeline::explicit_line<Number>,
                              [&](const Pixel&, const Number& minor) {
                                return Json{{"minor", number_to_json(minor, form)}};
                              });
}

template <class Number>
Json dda(const Json& object, const Form& form) {
  return draw<Number, Number>(object, form, pipeline::dda_line<Number>,
                              [&](const Pixel&, const Number& minor) {
                                return Json{{"minor", number_to_json(minor, form)}};
                              });
}

template <class Number>
Json bresenham(const Json& object, const Form& form) {
  return draw<std::int64_t, std::int64_t>(object, form, pipeline::bresenham_line,
                                          [](const Pixel&, std::int64_t error) {
                                            return Json{{"error", error}};
                                          });
}

template <class Number>
Json midpoint(const Json& object, const Form& form) {
  const pipeline::LineEnds ends = pixel_ends_of(object, form);
  const pipeline::LineAxes axes(ends);
  return draw<std::int64_t, std::int64_t>(
      object, form, pipeline::midpoint_line, [&](const Pixel& pixel, std::int64_t d) {
        Json step{{"d", d}};
        // At the last pixel nothing is left to choose.
        if (pixel == Pixel{ends.x1, ends.y1}) return step;
        const std::int64_t minor = axes.steep ? pixel.x : pixel.y;
        const bool north_east = d > 0 || (d == 0 && axes.steps_at_tie(minor));
        step["choice"] = north_east ? "NE" : "E";
        return step;
      });
}

template <class Number>
Json diamond_exit(const Json& object, const Form& form) {
  const std::vector<double> ends = ends_of(object);
  const auto number = [&](std::size_t i) { return pipeline::number_from<Number>(ends[i]); };
  const PixelWindow window = window_of(object);
  cases::check_effort<Number>(tests_of_a_column * columns_of(ends, window), "tests of diamonds",
                              window_limits_it);
  PixelList pixels(form.runs);
  Json steps = Json::array();
  pipeline::diamond_exit_passages<Number>(
      {number(0), number(1), number(2), number(3)}, window,
      [&](const pipeline::DiamondPassage<Number>& passage) {
        pixels.add(passage.pixel);
        if (!form.numbers.trace) return;
        pixels.make_room(entries_of_a_step);
        steps.push_back({{"pixel", {passage.pixel.x, passage.pixel.y}},
                         {"enters", number_to_json(passage.enters, form)},
                         {"leaves", number_to_json(passage.leaves, form)}});
      });
  Json result = pixels.json(false);
  if (form.numbers.trace)
    result["trace"] = {{"axis", is_steep(ends) ? "y" : "x"}, {"steps", steps}};
  return result;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
template <class Number>
Json line_forms(const Json& object, const Form& form) {
  using pipeline::number_from;
  cases::expect_only(object, {"line", "points", "parameters"});
  const std::vector<double> ends = cases::numbers(cases::member(object, "line"), "line", 4, 4);
  const auto number = [&](const Number& x) { return number_to_json(x, form); };
  const auto point = [&](double x, double y) {
    return clipping::Point2<Number>{number_from<Number>(x), number_from<Number>(y)};
  };
  const pipeline::LineForms<Number> line(point(ends[0], ends[1]), point(ends[2], ends[3]));
  if (line.is_point()) throw InputError("line: its ends are the same; expected two points");
  Json result{{"explicit", nullptr}};
  if (const auto f = line.as_explicit())
    result["explicit"] = {{"slope", number(f->slope)}, {"intercept", number(f->intercept)}};
  for (const Number& x : line.implicit()) result["implicit"].push_back(number(x));
  if (object.contains("points")) {
    result["points"] = Json::array();
    for (const auto& p : cases::points(object, "points", 2, 2)) {
      const Number value = line.value_at(point(p[0], p[1]));
      result["points"].push_back({{"value", number(value)},
                                  {"side", value > 0   ? "left"
                                           : value < 0 ? "right"
                                                       : "on"},
                                  {"t", number(line.parameter_of(point(p[0], p[1])))}});
    }
  }
  if (object.contains("parameters")) {
    result["at"] = Json::array();
    for (const double t : cases::numbers(object["parameters"], "parameters", 0, 1 << 20)) {
      result["at"].push_back(point_to_json(line.at(number_from<Number>(t)), form));
    }
  }
  return result;
}

#define FATHOM_INSTANTIATE(Number)                               \
  template Json line_forms<Number>(const Json&, const Form&);    \
  template Json explicit_line<Number>(const Json&, const Form&); \
  template Json dda<Number>(const Json&, const Form&);           \
  template Json bresenham<Number>(const Json&, const Form&);     \
  template Json midpoint<Number>(const Json&, const Form&);      \
  template Json diamond_exit<Number>(const Json&, const Form&);
FATHOM_INSTANTIATE(pipeline::Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::app::scan
