#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>

#include "apps/page_data.h"
#include "apps/validate/report/page.h"
#include "apps/validate/report/report_formats.h"
#include "fathom/image/preview.h"

namespace fathom::validation {
namespace {

using attribution::PixelClass;
using attribution::Truth;
using Bytes = std::vector<unsigned char>;
using Json = nlohmann::ordered_json;

/// In zlib's format, which browsers read as "deflate".
std::string compressed(const Bytes& bytes) {
  uLongf length = ::compressBound(bytes.size());
  Bytes result(length);
  if (::compress2(result.data(), &length, bytes.data(), bytes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  result.resize(length);
  return app::base64(result);
}

/// 32-bit words, first all their lowest bytes, then the next: neighbours are alike there.
Bytes in_planes(const std::vector<std::uint32_t>& words) {
  Bytes bytes(4 * words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      bytes[k * words.size() + i] = static_cast<unsigned char>(words[i] >> 8 * k);
    }
  }
  return bytes;
}

std::uint32_t bits_of(double value) {
  const auto rounded = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &rounded, sizeof bits);
  return bits;
}

nlohmann::json scene_data(const Truth& truth) {
  std::vector<std::uint32_t> depths;
  for (const double depth : truth.depths) depths.push_back(bits_of(depth));
  return {{"width", truth.camera.width},
          {"height", truth.camera.height},
          {"depths", compressed(in_planes(depths))},
          {"triangles", compressed(in_planes(truth.triangles))}};
}

/// The other's depths as binary32, less the truth's, bits by bits: mostly small numbers.
nlohmann::json case_data(const ValidationCase& c) {
  if (!c.is_done()) return nullptr;
  std::vector<std::uint32_t> differences;
  for (std::size_t i = 0; i < c.other.depths.size(); ++i) {
    differences.push_back(bits_of(c.other.depths[i]) - bits_of(c.truth->depths[i]));
  }
  Bytes classes;
  for (const PixelClass k : c.attribution.classes) classes.push_back(static_cast<unsigned char>(k));
  return {{"differences", compressed(in_planes(differences))}, {"classes", compressed(classes)}};
}

/// From the nearest depth to the farthest, as previews have them.
nlohmann::json depth_colours() {
  constexpr int count = 256;
  nlohmann::json colours = nlohmann::json::array();
  for (int k = 0; k < count; ++k) {
    colours.push_back(colour_at(ColourMap::viridis, static_cast<double>(k) / (count - 1)));
  }
  return colours;
}

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

std::string to_html(const std::vector<ValidationCase>& cases) {
  nlohmann::json data{{"scenes", nlohmann::json::object()}, {"maps", nlohmann::json::array()}};
  for (const ValidationCase& c : cases) {
    if (c.is_done() && !data["scenes"].contains(c.scene)) {
      data["scenes"][c.scene] = scene_data(*c.truth);
    }
    data["maps"].push_back(case_data(c));
  }
  std::string html;
  for (const std::string_view part : {page::head, page::style, page::body}) html += part;
  html += app::script_data("report", to_json(cases));
  html += app::script_data("depth-colours", depth_colours().dump());
  html +=
      app::script_data("maps", data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  html += "<script>\n";
  for (const std::string_view part :
       {page::elements, page::words, page::overview, page::data, page::maps, page::colours,
        page::result, page::plots, page::start}) {
    html += part;
  }
  return html + "</script>\n</body></html>\n";
}

std::string to_html(const Comparison& comparison) {
  Json data{{"fathom", {{"before", comparison.fathom_before}, {"after", comparison.fathom_after}}},
            {"changes", Json::array()}};
  for (const ResultChange& change : comparison.changes) data["changes"].push_back(json_of(change));
  std::string html;
  for (const std::string_view part : {page::head, page::style, page::comparison_body}) html += part;
  html += app::script_data("comparison", data.dump(-1, ' ', false, Json::error_handler_t::replace));
  html += "<script>\n";
  for (const std::string_view part :
       {page::elements, page::words, page::overview, page::comparison})
    html += part;
  return html + "</script>\n</body></html>\n";
}

}  // namespace fathom::validation
