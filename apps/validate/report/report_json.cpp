#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/reported_result.h"
#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/attribution.h"
#include "fathom/text/version.h"

namespace fathom::validation {
namespace {

using attribution::Attribution;
using attribution::Finding;
using attribution::pixel_class_count;
using attribution::PixelClass;
using attribution::Truth;

using Json = nlohmann::ordered_json;

/// null where there is no finite number.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json geometry(const Truth& truth, std::uint32_t triangle) {
  Json corners = Json::array();
  for (const std::uint32_t corner : truth.mesh.triangles[triangle]) {
    corners.push_back(truth.mesh.points[corner]);
  }
  return corners;
}

Json pixel(const ValidationCase& c, std::size_t i) {
  const Attribution& a = c.attribution;
  const std::uint32_t triangle = c.truth->triangles[i];
  Json json{{"pixel", {i % c.other.width, i / c.other.width}},
            {"class", name_of(a.classes[i])},
            {"truth", number(c.truth->depths[i])},
            {"other", number(c.other.depths[i])},
            {"least", number(a.least[i])},
            {"greatest", number(a.greatest[i])}};
  if (triangle != no_surface) {
    json["triangle"] = triangle;
    json["corners"] = geometry(*c.truth, triangle);
  }
  return json;
}

Json list_of(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& f : findings) {
    Json json{{"kind", f.kind}, {"text", f.text}, {"pixels", f.pixels}};
    for (const attribution::Estimate& e : f.estimates) {
      json["estimates"].push_back({{"name", e.name},
                                   {"value", number(e.value)},
                                   {"standard_deviation", number(e.deviation)},
                                   {"unit", e.unit}});
    }
    if (!f.alternatives.empty()) json["alternatives"] = f.alternatives;
    if (!f.evidence.empty()) json["evidence"] = f.evidence;
    list.push_back(std::move(json));
  }
  return list;
}

Json result(const ValidationCase& c) {
  Json json{
      {"scene", c.scene}, {"renderer", c.renderer}, {"variant", c.variant}, {"version", c.version}};
  if (!c.file.empty()) json["file"] = c.file;
  json["verdict"] = verdict_of(c);
  if (!c.is_done()) {
    json["failure"] = c.failure;
    return json;
  }
  const Attribution& a = c.attribution;
  json["triangles"] = c.truth->mesh.triangles.size();
  json["width"] = c.other.width;
  json["height"] = c.other.height;
  json["model"] = c.model.name;
  for (std::size_t k = 0; k < pixel_class_count; ++k) {
    json["pixels"][name_of(static_cast<PixelClass>(k))] = a.counts[k];
  }
  const std::uint64_t fighting = a.count(PixelClass::z_fight);
  const bool has_numbers = c.has_triangle_numbers();
  json["z_fighting"] = {
      {"triangle_numbers", has_numbers},
      {"pixels", has_numbers ? Json(fighting) : Json(nullptr)},
      {"at_least", fighting},
      {"by_format_alone", c.predicted_fights ? Json(*c.predicted_fights) : Json(nullptr)}};
  json["bounds"] = {{"median_relative_width", number(a.sharpness.median_relative_width)},
                    {"median_width_in_steps", number(a.sharpness.median_steps_width)},
                    {"may_share", a.sharpness.may_share}};
  json["errors"] = {{"pixels", a.errors.pixels},
                    {"greatest", a.errors.greatest},
                    {"mean", a.errors.mean},
                    {"greatest_relative", a.errors.greatest_relative},
                    {"median_relative", a.errors.median_relative}};
  json["bias_in_steps"] = a.bias.steps;
  json["findings"] = list_of(a.findings);
  json["notes"] = list_of(a.notes);
  json["worst"] = Json::array();
  for (const std::size_t i :
       attribution::worst_pixels(*c.truth, c.other, c.attribution, listed_pixels))
    json["worst"].push_back(pixel(c, i));
  return json;
}

}  // namespace

std::string to_json(const std::vector<ValidationCase>& cases) {
  Json json{{"fathom", text::version_in_outputs()},
            {"format", report_format},
            {"verdict", verdict_of(cases)},
            {"results", Json::array()}};
  for (const ValidationCase& c : cases) json["results"].push_back(result(c));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fathom::validation
