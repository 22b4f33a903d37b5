#include "apps/bench/parts/parts_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/bench/report.h"

namespace fathom::bench {
namespace {

/// The names of all counts, in the order in which variants have them.
std::vector<std::string> count_names(const IdeaTimes& idea) {
  std::vector<std::string> names;
  for (const VariantTimes& variant : idea.variants) {
    for (const Count& count : variant.counts) {
      if (std::find(names.begin(), names.end(), count.name) == names.end())
        names.push_back(count.name);
    }
  }
  return names;
}

std::string text_of(double value) {
  return value == std::floor(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.1f}", value);
}

std::string text_of(const Counts& counts, const std::string& name) {
  for (const Count& count : counts) {
    if (count.name == name) return text_of(count.value);
  }
  return "-";
}

nlohmann::ordered_json number(double value) {
  if (value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

nlohmann::ordered_json result(const PartsOfScene& parts, const IdeaTimes& idea,
                              const VariantTimes& variant) {
  nlohmann::ordered_json counts = nlohmann::ordered_json::object();
  for (const Count& count : variant.counts) counts[count.name] = number(count.value);
  return {{"scene", parts.scene},
          {"triangles", parts.triangles},
          {"width", parts.width},
          {"height", parts.height},
          {"idea", idea.name},
          {"variant", variant.name},
          {"plain", variant.plain},
          {"median_ms", variant.median_ms()},
          {"min_ms", variant.milliseconds.front()},
          {"max_ms", variant.milliseconds.back()},
          {"runs", variant.milliseconds.size()},
          {"speed_up", variant.speed_up},
          {"counts", counts}};
}

}  // namespace

std::string heading(const PartsOfScene& parts) {
  return fmt::format("{}: {} triangle{}, {}x{}\n", parts.scene, parts.triangles,
                     parts.triangles == 1 ? "" : "s", parts.width, parts.height);
}

std::string table(const IdeaTimes& idea) {
  std::string text = idea.name + (idea.note.empty() ? "" : " (" + idea.note + ")") + "\n";
  std::size_t widest = 0;
  for (const VariantTimes& variant : idea.variants) widest = std::max(widest, variant.name.size());
  const std::vector<std::string> names = count_names(idea);
  text += fmt::format("  {:<{}}{:>11}{:>11}{:>9}", "", widest, "median ms", "least ms", "x plain");
  for (const std::string& name : names) text += fmt::format("  {:>11}", name);
  text += "\n";
  for (const VariantTimes& variant : idea.variants) {
    text +=
        fmt::format("  {:<{}}{:>11.3f}{:>11.3f}{:>9}", variant.name, widest, variant.median_ms(),
                    variant.milliseconds.front(),
                    variant.name == variant.plain ? "1" : fmt::format("{:.2f}", variant.speed_up));
    for (const std::string& name : names) {
      text += fmt::format("  {:>{}}", text_of(variant.counts, name),
                          std::max<std::size_t>(name.size(), 11));
    }
    text += "\n";
  }
  return text + "\n";
}

std::string table(const std::vector<RuleCounts>& rules) {
  std::string text =
      "closed edges (pixels by each rule; closed: every centre on the outline too)\n";
  std::size_t widest = 0;
  for (const RuleCounts& rule : rules) widest = std::max(widest, rule.name.size());
  text +=
      fmt::format("  {:<{}}{:>12}{:>12}{:>12}\n", "", widest, "half-open", "closed", "difference");
  for (const RuleCounts& rule : rules) {
    text += fmt::format("  {:<{}}{:>12}{:>12}{:>12}\n", rule.name, widest, rule.half_open,
                        rule.closed, rule.closed - rule.half_open);
  }
  return text + "\n";
}

std::string to_json(const Machine& machine, const std::vector<PartsOfScene>& all,
                    const std::vector<RuleCounts>& rules) {
  using Json = nlohmann::ordered_json;
  Json results = Json::array(), left_out = Json::array(), closed_edges = Json::array();
  for (const PartsOfScene& parts : all) {
    for (const IdeaTimes& idea : parts.ideas)
      for (const VariantTimes& variant : idea.variants)
        results.push_back(result(parts, idea, variant));
    for (const std::string& why : parts.left_out)
      left_out.push_back({{"scene", parts.scene}, {"why", why}});
  }
  for (const RuleCounts& rule : rules) {
    closed_edges.push_back(
        {{"name", rule.name}, {"half_open", rule.half_open}, {"closed", rule.closed}});
  }
  const Json report{{"machine", to_json(machine)},
                    {"results", results},
                    {"left_out", left_out},
                    {"closed_edges", closed_edges}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace fathom::bench
