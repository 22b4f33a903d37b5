#include "apps/validate/report/comparison_html.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/validate/report/page.h"
#include "apps/validate/report/script_data.h"

namespace fathom::validation {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json json_of(const ReportedResult& result) {
  if (!result.is_done()) return {{"version", result.version}, {"failure", result.failure}};
  Json json{{"version", result.version},
            {"median_error", number(result.median_error)},
            {"greatest_error", number(result.greatest_error)},
            {"findings", Json::array()}};
  for (std::size_t k = 0; k < result.counts.size(); ++k) {
    json["pixels"][name_of(static_cast<attribution::PixelClass>(k))] = result.counts[k];
  }
  for (const attribution::Finding& f : result.findings) {
    json["findings"].push_back({{"kind", f.kind}, {"text", f.text}, {"pixels", f.pixels}});
  }
  return json;
}

Json json_of(const ResultChange& change) {
  const bool is_new = change.verdict == Verdict::appeared,
             is_gone = change.verdict == Verdict::gone;
  return {{"scene", change.after.scene},
          {"renderer", change.after.renderer},
          {"variant", change.after.variant},
          {"verdict", name_of(change.verdict)},
          {"worse", change.worse},
          {"better", change.better},
          {"obstacle", change.obstacle},
          {"before", is_new ? Json(nullptr) : json_of(change.before)},
          {"after", is_gone ? Json(nullptr) : json_of(change.after)}};
}

}  // namespace

std::string to_html(const Comparison& comparison) {
  Json data{{"fathom", {{"before", comparison.fathom_before}, {"after", comparison.fathom_after}}},
            {"changes", Json::array()}};
  for (const ResultChange& change : comparison.changes) data["changes"].push_back(json_of(change));
  std::string html;
  for (const std::string_view part : {page::head, page::style, page::comparison_body}) html += part;
  html += script_data("comparison", data.dump(-1, ' ', false, Json::error_handler_t::replace));
  html += "<script>\n";
  for (const std::string_view part :
       {page::elements, page::words, page::overview, page::comparison})
    html += part;
  return html + "</script>\n</body></html>\n";
}

}  // namespace fathom::validation
