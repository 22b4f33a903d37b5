#include "validation/report/baseline.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "fathom/text/input_file.h"
#include "fathom/text/parse_json.h"

namespace fathom::validation {
namespace {

using attribution::Attribution;
using attribution::Finding;
using attribution::PixelClass;

using Json = nlohmann::json;

std::string key_of(const std::string& scene, const std::string& renderer,
                   const std::string& variant) {
  return scene + ", " + renderer + (variant.empty() ? "" : " " + variant);
}

const Json* find(const Json& results, const std::string& key) {
  for (const Json& result : results) {
    if (key_of(result.at("scene"), result.at("renderer"), result.at("variant")) == key)
      return &result;
  }
  return nullptr;
}

void compare(const ValidationCase& now, const Json& then, const std::string& key,
             std::vector<std::string>& lines) {
  if (then.contains("failure")) return;
  if (!now.is_done()) {
    lines.push_back(fmt::format("{}: was drawn in the baseline; now: {}", key, now.failure));
    return;
  }
  const Attribution& a = now.attribution;
  for (const PixelClass c : {PixelClass::unexplained, PixelClass::missed, PixelClass::equal}) {
    const auto before = then.at("pixels").at(name_of(c)).get<std::uint64_t>();
    const bool worse = c == PixelClass::equal ? a.count(c) < before : a.count(c) > before;
    if (worse) {
      lines.push_back(
          fmt::format("{}: {} {} pixels, {} in the baseline", key, a.count(c), name_of(c), before));
    }
  }
  for (const Finding& finding : a.findings) {
    bool known = false;
    for (const Json& f : then.at("findings")) known = known || f.at("kind") == finding.kind;
    if (!known) lines.push_back(fmt::format("{}: {}", key, finding.text));
  }
}

}  // namespace

std::vector<std::string> regressions(const std::vector<ValidationCase>& cases,
                                     const std::filesystem::path& baseline) {
  const text::InputFile file(baseline);
  const auto refuse = [&](const char* why) {
    throw InputError(baseline.string() + ": is not a report.json of fathom validate: " + why);
  };
  std::vector<std::string> lines;
  try {
    const auto report = text::parse_json<Json>(file.text());
    const Json& results = report.at("results");
    for (const ValidationCase& now : cases) {
      const std::string key = key_of(now.scene, now.renderer, now.variant);
      if (const Json* then = find(results, key)) compare(now, *then, key, lines);
    }
  } catch (const text::JsonFault& fault) {
    refuse(fault.what());
  } catch (const Json::exception& error) {
    refuse(error.what());
  }
  return lines;
}

}  // namespace fathom::validation
