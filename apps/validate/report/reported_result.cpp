#include "apps/validate/report/reported_result.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/version.h"

namespace fathom::validation {
namespace {

using Json = nlohmann::json;

constexpr const char* remedy = "; write it again: fathom validate … -o DIR";

/// NaN for null, which is how reports say that there is no such number.
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

ReportedResult result_of(const Json& json) {
  ReportedResult result{.scene = json.at("scene"),
                        .renderer = json.at("renderer"),
                        .variant = json.at("variant"),
                        .version = json.at("version"),
                        .failure = json.value("failure", "")};
  if (!result.is_done()) return result;
  json.at("width").get_to(result.width);
  json.at("height").get_to(result.height);
  json.at("triangles").get_to(result.triangles);
  for (std::size_t k = 0; k < result.counts.size(); ++k) {
    const std::string name = name_of(static_cast<attribution::PixelClass>(k));
    json.at("pixels").at(name).get_to(result.counts[k]);
  }
  result.median_error = number(json.at("errors").at("median_relative"));
  result.greatest_error = number(json.at("errors").at("greatest_relative"));
  result.median_bound = number(json.at("bounds").at("median_relative_width"));
  for (const Json& finding : json.at("findings")) {
    result.findings.push_back({finding.at("kind"), finding.at("text"), finding.at("pixels")});
  }
  return result;
}

Report report_of(const Json& json, const std::string& name) {
  Report report{.fathom = json.at("fathom"), .results = {}};
  const int format = json.value("format", report_format);
  if (format != report_format) {
    throw InputError(fmt::format(
        "{}: is a report of layout {}, by Fathom {}, and this Fathom ({}) reads layout {}{}", name,
        format, report.fathom, text::version_in_outputs(), report_format, remedy));
  }
  for (const Json& result : json.at("results")) report.results.push_back(result_of(result));
  return report;
}

/// A syntax error at the last byte means that the file was truncated.
bool is_cut_off(const text::JsonFault& fault, std::string_view text) {
  return fault.kind() == text::JsonFault::Kind::syntax && fault.byte() >= text.size();
}

}  // namespace

std::string title_of(const std::string& scene, const std::string& renderer,
                     const std::string& variant) {
  return scene + ", " + renderer + (variant.empty() ? "" : " " + variant);
}

Report reported(const std::vector<ValidationCase>& cases) {
  Report report{.fathom = text::version_in_outputs(), .results = {}};
  for (const ValidationCase& c : cases) {
    ReportedResult result{.scene = c.scene,
                          .renderer = c.renderer,
                          .variant = c.variant,
                          .version = c.version,
                          .failure = c.failure};
    if (c.is_done()) {
      result.width = c.other.width;
      result.height = c.other.height;
      result.triangles = c.truth->mesh.triangles.size();
      result.counts = c.attribution.counts;
      result.median_error = c.attribution.errors.median_relative;
      result.greatest_error = c.attribution.errors.greatest_relative;
      result.median_bound = c.attribution.sharpness.median_relative_width;
      result.findings = c.attribution.findings;
    }
    report.results.push_back(std::move(result));
  }
  return report;
}

Report read_report(const std::filesystem::path& file) {
  const files::InputFile input(file);
  const std::string name = file.string();
  try {
    return report_of(text::parse_json<Json>(input.text()), name);
  } catch (const text::JsonFault& fault) {
    if (is_cut_off(fault, input.text())) {
      throw InputError(name + ": is cut off: it ends within its JSON" + remedy);
    }
    throw InputError(name + ": is not a report.json of fathom validate: " + fault.what() + remedy);
  } catch (const Json::exception& error) {
    throw InputError(name + ": is not a report.json of fathom validate: " + error.what() + remedy);
  }
}

}  // namespace fathom::validation
