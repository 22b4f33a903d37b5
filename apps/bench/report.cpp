#include "apps/bench/report.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fathom::bench {
namespace {

/// How many times fast's median the median of `m` is; nothing where fast was not timed.
std::optional<double> ratio_to_fast(const Comparison& comparison, const Measurement& m) {
  for (const Measurement& fast : comparison.measurements) {
    if (fast.renderer == "fast") return m.median_ms() / fast.median_ms();
  }
  return std::nullopt;
}

double per_second(double count, double milliseconds) {
  return count / (milliseconds * 1e-3);
}

/// Pixels of the image; building a hierarchy draws none.
double pixels(const Plan& plan, const Measurement& m) {
  return m.renderer == "embree-build" ? 0 : static_cast<double>(plan.width) * plan.height;
}

/// The width of the first column.
std::size_t name_width(const Comparison& comparison) {
  std::size_t width = 14;
  for (const Measurement& m : comparison.measurements) {
    width = std::max(width, m.renderer.size());
  }
  return width;
}

std::string row(const Comparison& comparison, const Measurement& m) {
  const double median = m.median_ms();
  const auto ratio = ratio_to_fast(comparison, m);
  const double drawn = pixels(comparison.plan, m);
  return fmt::format("  {:<{}}{:>11.2f}{:>11.2f}{:>11.2f}{:>9}{:>10.1f}{:>9.3g}{:>9}\n", m.renderer,
                     name_width(comparison), median, m.milliseconds.front(), m.milliseconds.back(),
                     ratio ? fmt::format("{:.2f}", *ratio) : "-",
                     static_cast<double>(m.peak_bytes) / (1 << 20),
                     per_second(static_cast<double>(comparison.triangles), median) * 1e-6,
                     drawn > 0 ? fmt::format("{:.1f}", per_second(drawn, median) * 1e-6) : "-");
}

nlohmann::ordered_json result(const Comparison& comparison, const Measurement& m) {
  const Plan& plan = comparison.plan;
  nlohmann::ordered_json json{
      {"scene", plan.scene},
      {"triangles", comparison.triangles},
      {"width", plan.width},
      {"height", plan.height},
      {"threads", plan.threads},
      {"renderer", m.renderer},
      {"median_ms", m.median_ms()},
      {"min_ms", m.milliseconds.front()},
      {"max_ms", m.milliseconds.back()},
      {"first_ms", m.first_ms},
      {"runs", m.milliseconds.size()},
      {"peak_bytes", m.peak_bytes},
      {"covered_pixels", m.covered_pixels},
      {"triangles_per_second",
       per_second(static_cast<double>(comparison.triangles), m.median_ms())}};
  const auto ratio = ratio_to_fast(comparison, m);
  json["ratio_to_fast"] = ratio ? nlohmann::json(*ratio) : nlohmann::json();
  const double drawn = pixels(plan, m);
  json["pixels_per_second"] =
      drawn > 0 ? nlohmann::json(per_second(drawn, m.median_ms())) : nlohmann::json();
  if (!m.description.empty()) json["version"] = m.description;
  return json;
}

}  // namespace

std::string table(const Comparison& comparison) {
  const Plan& plan = comparison.plan;
  std::string text =
      fmt::format("{}: {} triangle{}, {}x{}, {} thread{}\n", plan.scene, comparison.triangles,
                  comparison.triangles == 1 ? "" : "s", plan.width, plan.height, plan.threads,
                  plan.threads == 1 ? "" : "s");
  text += fmt::format("  {:<{}}{:>11}{:>11}{:>11}{:>9}{:>10}{:>9}{:>9}\n", "renderer",
                      name_width(comparison), "median ms", "min ms", "max ms", "x fast", "peak MiB",
                      "Mtri/s", "Mpix/s");
  for (const Measurement& m : comparison.measurements) text += row(comparison, m);
  return text + "\n";
}

std::string to_json(const Machine& machine, const std::vector<Comparison>& comparisons) {
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  for (const Comparison& comparison : comparisons) {
    for (const Measurement& m : comparison.measurements) {
      results.push_back(result(comparison, m));
    }
  }
  const nlohmann::ordered_json report{{"machine", to_json(machine)}, {"results", results}};
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace fathom::bench
