#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/doctor/diagnosis.h"
#include "apps/shell/standard_streams.h"
#include "fathom/text/counted.h"
#include "fathom/text/percentage.h"

namespace fathom::doctor {
namespace {

using Json = nlohmann::ordered_json;

std::string figures(const Agreement& a) {
  if (a.compared == 0)
    return fmt::format("{:>7} of {} explained: the mesh is at none of them", "0 %",
                       text::counted(a.pixels, "pixel"));
  return fmt::format("{:>7} of {} explained, residual {:.3g} (median), {:.3g} (largest)",
                     text::percentage(a.share), text::counted(a.pixels, "pixel"), a.median,
                     a.largest);
}

Json as_json(const Agreement& a) {
  return {{"pixels", a.pixels},
          {"explained", a.share},
          {"silhouettes", a.silhouettes},
          {"median_residual", a.compared > 0 ? Json(a.median) : Json(nullptr)},
          {"largest_residual", a.compared > 0 ? Json(a.largest) : Json(nullptr)}};
}

std::string verdict_text(const Diagnosis& found) {
  switch (found.verdict) {
    case Verdict::well:
      return found.is_noisy ? "no fault, but noisy depths" : "all is well";
    case Verdict::faulty:
      return text::counted(found.faults.size(), "fault") +
             (found.is_noisy ? ", and noisy depths" : "");
    case Verdict::unclear:
      return "cannot tell: several explanations fit equally well";
    case Verdict::unknown:
      break;
  }
  return "no known fault explains the depth images";
}

bool is_curable(const Diagnosis& found) {
  return found.verdict == Verdict::faulty;
}

}  // namespace

std::string to_text(const Diagnosis& found, const std::string& cure) {
  std::string text = fmt::format("{}\n  as given  {}\n", verdict_text(found), figures(found.given));
  if (!found.faults.empty()) text += fmt::format("  corrected {}\n", figures(found.corrected));
  constexpr double visible_tolerance = 1e-6;
  const std::string limit = found.tolerance < visible_tolerance
                                ? std::string("the rounding of its number")
                                : fmt::format("{:.2g} % or half a code", 100 * found.tolerance);
  text += fmt::format(
      "  {} looked at; a pixel is explained if its depth differs by at most {}; residuals in scene "
      "units\n",
      text::counted(found.images, "image"), limit);
  const attribution::Location& deviation = found.noise.deviation;
  if (deviation.spread > visible_tolerance)
    text += fmt::format("  {} deviate by {:+.2g} % (median) with a spread of {:.2g} %\n",
                        found.faults.empty() ? "depths" : "corrected depths",
                        100 * deviation.median, 100 * deviation.spread);
  for (const FoundFault& fault : found.faults) {
    text += fmt::format("{}: {}\n", fault.name, fault.text);
    text += fmt::format("  before    {}\n  after     {}\n", figures(fault.evidence.before),
                        figures(fault.evidence.after));
    for (const std::string& other : fault.alternatives)
      text += fmt::format("  or        {}\n", other);
  }
  for (const std::string& note : found.notes) text += "note: " + note + "\n";
  if (is_curable(found) && !cure.empty())
    text += "to correct cameras and depth images:\n  " + cure + "\n";
  return text;
}

std::string to_json(const Diagnosis& found, const std::string& cure) {
  Json faults = Json::array();
  for (const FoundFault& fault : found.faults) {
    Json one{{"name", fault.name},
             {"text", fault.text},
             {"before", as_json(fault.evidence.before)},
             {"after", as_json(fault.evidence.after)}};
    if (!fault.alternatives.empty()) one["alternatives"] = fault.alternatives;
    faults.push_back(one);
  }
  const Json answer{{"verdict", name_of(found.verdict)},
                    {"images", found.images},
                    {"tolerance", found.tolerance},
                    {"given", as_json(found.given)},
                    {"corrected", as_json(found.corrected)},
                    {"noise",
                     {{"median", found.noise.deviation.median},
                      {"spread", found.noise.deviation.spread},
                      {"same_side", found.noise.same_side}}},
                    {"faults", faults},
                    {"notes", found.notes},
                    {"command", is_curable(found) && !cure.empty() ? Json(cure) : Json(nullptr)}};
  return app::json_answer(answer);
}

}  // namespace fathom::doctor
