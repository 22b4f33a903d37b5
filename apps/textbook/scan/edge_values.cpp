// fathom scan --algorithm edge-values: the textbook's exercise on edge functions.

#include <fmt/format.h>

#include <array>

#include "apps/textbook/cases/case_effort.h"
#include "apps/textbook/scan/scan_cases.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/failures/errors.h"
#include "fathom/image/files/npy_array.h"
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

}  // namespace fathom::app::scan
