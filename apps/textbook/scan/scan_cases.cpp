// fathom scan --algorithm edge-values: the textbook's exercise on edge functions.

#include "apps/textbook/scan/scan_cases.h"

#include <fmt/format.h>

#include <array>

#include "apps/shell/values.h"
#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/failures/errors.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/scan/edge_function.h"

namespace fathom::app::scan {
namespace {

constexpr const char* edge_names[] = {"BC", "CA", "AB"};

/// A value in binary64; those written as "p/q" were asked for with --exact.
double binary64_of(const Json& value) {
  return value.is_string() ? clipping::to_binary64(clipping::Rational(value.get<std::string>()))
                           : value.get<double>();
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string csv_of(const Json& answer) {
  std::string csv = "x,y,BC,CA,AB\n";
  const Json& rows = answer["values"];
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x)
      csv += fmt::format("{},{},{},{},{}\n", x, y, text_of(rows[y][x][0]), text_of(rows[y][x][1]),
                         text_of(rows[y][x][2]));
  return csv;
}

std::string npy_of(const Json& answer) {
  const Json& rows = answer["values"];
  if (rows.empty())
    throw InputError("the triangle has no area, so there are no values for an array");
  const image::ImageSize size{static_cast<std::uint32_t>(rows[0].size()),
                              static_cast<std::uint32_t>(rows.size())};
  std::array<ImageChannel, 3> channels;
  std::vector<const ImageChannel*> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    Samples<double> values(rows.size() * rows[0].size());
    std::size_t i = 0;
    for (const Json& row : rows)
      for (const Json& pixel : row) values[i++] = binary64_of(pixel[k]);
    channels[k] = {fmt::format("edges.{}", k), std::move(values)};
    parts.push_back(&channels[k]);
  }
  const auto bytes = image::npy_of_channels(size, parts);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

template <class Number>
Json edge_values(const Json& object, const Form& form) {
  cases::expect_only(object, {"triangle", "width", "height"}, "edge-values");
  const clipping::Ring<double> ring = triangle_of(object, form);
  for (const char* key : {"width", "height"}) cases::member(object, key);
  const pipeline::PixelWindow window = window_of(object);
  cases::check_effort<Number>(
      3 * static_cast<double>(window.x_end) * static_cast<double>(window.y_end),
      "edge functions at the pixels of the image", "ask for a smaller image");
  std::array<pipeline::Point<Number>, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = {pipeline::number_from<Number>(ring[k].x),
                  pipeline::number_from<Number>(ring[k].y)};
  Json result{{"edges", Json::array()}, {"values", Json::array()}};
  const auto triangle = pipeline::edge_functions(corners);
  if (!triangle) return result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& e = triangle->edges[k];
    result["edges"].push_back({{"edge", edge_names[k]},
                               {"a", number_to_json(e.a, form)},
                               {"b", number_to_json(e.b, form)},
                               {"c", number_to_json(e.c, form)}});
  }
  for (std::int64_t y = 0; y < window.y_end; ++y) {
    Json& row = result["values"].emplace_back(Json::array());
    for (std::int64_t x = 0; x < window.x_end; ++x) {
      Json& pixel = row.emplace_back(Json::array());
      for (const auto& e : triangle->edges)
        pixel.push_back(number_to_json(
            Number(e.at(pipeline::centre_of<Number>(x), pipeline::centre_of<Number>(y))), form));
    }
  }
  return result;
}

std::string values_file(const Json& answer, ValuesFormat format) {
  return format == ValuesFormat::csv ? csv_of(answer) : npy_of(answer);
}

template Json edge_values<pipeline::Exact>(const Json&, const Form&);
template Json edge_values<double>(const Json&, const Form&);
template Json edge_values<float>(const Json&, const Form&);

namespace {

using pipeline::Exact;

constexpr Answers drawing_pixels{.pixels = true, .steps = true};
constexpr Answers stepping{.pixels = true, .steps = true, .ties = true};
constexpr Answers filling_triangles{.pixels = true, .steps = true, .triangles = true};
constexpr Answers half_planes{.pixels = true, .steps = true, .triangles = true, .edges = true};
constexpr Answers filling{.pixels = true};
constexpr Answers valuing{.triangles = true, .values = true};
constexpr Answers question{};

// Templates cannot be put in parentheses.
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define FATHOM_SCAN(name) name<Exact>, name<double>, name<float>
const std::vector<NamedAlgorithm>& algorithms() {
  static const std::vector<NamedAlgorithm> all{
      {"explicit", FATHOM_SCAN(explicit_line), stepping},
      {"dda", FATHOM_SCAN(dda), stepping},
      {"bresenham", FATHOM_SCAN(bresenham), stepping},
      {"midpoint", FATHOM_SCAN(midpoint), stepping},
      {"diamond-exit", FATHOM_SCAN(diamond_exit), drawing_pixels},
      {"line-forms", FATHOM_SCAN(line_forms), question},
      {"even-odd", FATHOM_SCAN(even_odd), drawing_pixels},
      {"non-zero", FATHOM_SCAN(non_zero), drawing_pixels},
      {"flood", flood, flood, flood, filling},
      {"edge-function", FATHOM_SCAN(edge_function), half_planes},
      {"scan-line", FATHOM_SCAN(scan_line), filling_triangles},
      {"edge-values", FATHOM_SCAN(edge_values), valuing},
      {"inside", FATHOM_SCAN(inside), question},
      {"convexity", FATHOM_SCAN(convexity), question},
      {"tessellate", tessellate, tessellate, tessellate, question},
      {"convex-hull", FATHOM_SCAN(convex_hull), question}};
  return all;
}
#undef FATHOM_SCAN

}  // namespace

NamedAlgorithm parse_algorithm(const std::string& text) {
  for (const NamedAlgorithm& algorithm : algorithms())
    if (algorithm.name == text) return algorithm;
  refuse_word(text, algorithm_names());
}

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names;
  for (const NamedAlgorithm& algorithm : algorithms()) names.push_back(algorithm.name);
  return names;
}

Arithmetic parse_arithmetic(const std::string& text) {
  return parse_word<Arithmetic>(text, {{"exact", Arithmetic::exact},
                                       {"float64", Arithmetic::float64},
                                       {"float32", Arithmetic::float32}});
}

int parse_subpixel_bits(const std::string& text) {
  const std::int64_t bits = parse_whole(text);
  if (bits < 0 || bits > pipeline::most_subpixel_bits)
    throw UsageError(fmt::format("{} is not between 0 and 16", bits));
  return static_cast<int>(bits);
}

pipeline::TieRule parse_ties(const std::string& text) {
  using enum pipeline::TieRule;
  return parse_word<pipeline::TieRule>(text,
                                       {{"greater", greater}, {"even", even}, {"stay", stay}});
}

pipeline::EdgeRule parse_edges(const std::string& text) {
  using enum pipeline::EdgeRule;
  return parse_word<pipeline::EdgeRule>(text, {{"top-left", top_left}, {"closed", closed}});
}

void require_effect(const NamedAlgorithm& algorithm, const Form& form, bool draw) {
  const auto& [name, exact, float64, float32, answers] = algorithm;
  if (form.subpixel_bits && !answers.triangles)
    throw UsageError("--subpixel-bits is for triangles: edge-function and scan-line");
  if (form.ties && !answers.ties)
    throw UsageError("--ties is for lines: explicit, dda, bresenham and midpoint");
  if (form.edges && !answers.edges) throw UsageError("--edges is for edge-function");
  if (form.runs && !answers.pixels)
    throw UsageError(fmt::format("--runs: {} draws no pixels; leave the option out", name));
  if (form.numbers.trace && !answers.steps)
    throw UsageError(fmt::format("--trace: {} shows no steps; leave the option out", name));
  if (draw && !answers.drawable())
    throw UsageError(fmt::format("--draw: {} shows no steps; leave the option out", name));
  if (draw && form.runs) throw UsageError("--draw shows pixels; leave --runs out");
}

Algorithm in_arithmetic(const NamedAlgorithm& algorithm, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::float64:
      return algorithm.float64;
    case Arithmetic::float32:
      return algorithm.float32;
    default:
      return algorithm.exact;
  }
}

}  // namespace fathom::app::scan
