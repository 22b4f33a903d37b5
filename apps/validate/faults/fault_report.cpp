#include "apps/validate/faults/fault_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "fathom/text/counted.h"

namespace fathom::validation {
namespace {

using Json = nlohmann::ordered_json;

bool has_to_be_named(const FaultCase& c) {
  return c.failure.empty() && c.result.effect >= effect_to_be_named;
}

bool is_named(const FaultCase& c) {
  return c.result.is_found && c.result.is_named;
}

std::vector<std::string> renderers_of(const FaultStudy& study) {
  std::vector<std::string> names;
  for (const FaultCase& c : study.faults) {
    if (std::find(names.begin(), names.end(), c.renderer) == names.end()) {
      names.push_back(c.renderer);
    }
  }
  return names;
}

std::string effect_text(double effect) {
  return std::isinf(effect) ? "∞" : fmt::format("{:.2g}", effect);
}

using Cases = std::vector<const FaultCase*>;

Cases drawn_cases(const FaultStudy& study, const Fault& fault, const std::string& renderer) {
  Cases cases;
  for (const FaultCase& c : study.faults) {
    const bool is_one = c.fault == &fault && c.failure.empty();
    if (is_one && (renderer.empty() || c.renderer == renderer)) cases.push_back(&c);
  }
  return cases;
}

/// The least effect from which on all are named: "≤ 1.0"; of a fault without a size "yes".
std::string power(const Cases& cases, bool has_size) {
  if (cases.empty()) return "";
  double greatest_missed = 0, least = INFINITY, greatest = 0;
  for (const FaultCase* c : cases) {
    greatest = std::max(greatest, c->result.effect);
    if (!is_named(*c)) greatest_missed = std::max(greatest_missed, c->result.effect);
  }
  if (!has_size) {
    if (greatest < 1) return "within bounds";
    return greatest_missed >= effect_to_be_named ? "**no**" : "yes";
  }
  for (const FaultCase* c : cases) {
    if (c->result.effect > greatest_missed) least = std::min(least, c->result.effect);
  }
  return least < INFINITY ? effect_text(least) : "**no**";
}

/// Of the cases that have to be named, how many a comparison of pictures sees: "3 of 8".
std::string seen(const Cases& cases, const std::function<bool(const GoldenVerdicts&)>& sees) {
  const auto all = std::count_if(cases.begin(), cases.end(),
                                 [](const FaultCase* c) { return has_to_be_named(*c); });
  if (all == 0) return "";
  const auto count = std::count_if(cases.begin(), cases.end(), [&](const FaultCase* c) {
    return has_to_be_named(*c) && sees(c->result.golden);
  });
  return fmt::format("{} of {}", count, all);
}

std::string row_of(const FaultStudy& study, const Fault& fault,
                   const std::vector<std::string>& renderers) {
  std::string row = fmt::format("| {} | {} |", fault.group, fault.name);
  for (const std::string& renderer : renderers) {
    row += " " + power(drawn_cases(study, fault, renderer), fault.has_size()) + " |";
  }
  const Cases all = drawn_cases(study, fault, "");
  row += " " + seen(all, [](const GoldenVerdicts& g) { return g.vtk; }) + " |";
  row += " " + seen(all, [](const GoldenVerdicts& g) { return g.ssim; }) + " |";
  row += " " + seen(all, [](const GoldenVerdicts& g) { return g.one_percent; }) + " |\n";
  return row;
}

std::vector<const Fault*> faults_of(const FaultStudy& study) {
  std::vector<const Fault*> faults;
  for (const FaultCase& c : study.faults) {
    if (std::find(faults.begin(), faults.end(), c.fault) == faults.end()) faults.push_back(c.fault);
  }
  std::sort(faults.begin(), faults.end());  // as the catalogue has them
  return faults;
}

/// null if the number is not finite.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

}  // namespace

bool FaultStudy::is_good() const {
  return std::all_of(right.begin(), right.end(),
                     [](const RightCase& c) { return c.said.empty(); }) &&
         std::all_of(faults.begin(), faults.end(),
                     [](const FaultCase& c) { return !has_to_be_named(c) || is_named(c); });
}

std::string lines_of(const FaultStudy& study) {
  std::string text;
  std::uint64_t maps = 0, named = 0, all = 0;
  for (const RightCase& c : study.right) {
    if (!c.failure.empty()) {
      text += fmt::format("{}, {}: {}\n", c.scene, c.renderer, c.failure);
    } else if (!c.said.empty()) {
      text += fmt::format("{}, {}: found in a right map: {}\n", c.scene, c.renderer, c.said);
    }
    maps += c.failure.empty() ? 1 : 0;
  }
  for (const FaultCase& c : study.faults) {
    if (!c.failure.empty()) {
      text += fmt::format("{}, {}, {}: {}\n", c.scene, c.renderer, c.fault->name, c.failure);
    }
    if (!has_to_be_named(c)) continue;
    ++all;
    if (is_named(c)) {
      ++named;
    } else {
      text += fmt::format("{}, {}, {} {:.3g} {} ({} bounds): {}\n", c.scene, c.renderer,
                          c.fault->name, c.result.size, c.fault->unit, effect_text(c.result.effect),
                          c.result.is_found ? "said to be " + c.result.said : "not found");
    }
  }
  return text + fmt::format("{}; {} of {} of {} bounds or more found and rightly named\n",
                            text::counted(maps, "right map"), named, text::counted(all, "fault"),
                            effect_to_be_named);
}

std::string to_markdown(const FaultStudy& study) {
  const std::vector<std::string> renderers = renderers_of(study);
  std::string head = "| group | fault |", rule = "| --- | --- |";
  for (const std::string& renderer : renderers) {
    head += " " + renderer + " |";
    rule += " --- |";
  }
  std::string text =
      head + " vtkImageDifference | SSIM | 1 % rule |\n" + rule + " --- | --- | --- |\n";
  for (const Fault* fault : faults_of(study)) text += row_of(study, *fault, renderers);
  return text;
}

std::string to_json(const FaultStudy& study) {
  Json json{{"right_maps", Json::array()}, {"faults", Json::array()}};
  for (const RightCase& c : study.right) {
    json["right_maps"].push_back(
        {{"scene", c.scene}, {"renderer", c.renderer}, {"failure", c.failure}, {"said", c.said}});
  }
  for (const FaultCase& c : study.faults) {
    const FaultResult& r = c.result;
    json["faults"].push_back({{"group", c.fault->group},
                              {"fault", c.fault->name},
                              {"scene", c.scene},
                              {"renderer", c.renderer},
                              {"failure", c.failure},
                              {"size", r.size},
                              {"unit", c.fault->unit},
                              {"effect", number(r.effect)},
                              {"found", r.is_found},
                              {"named", r.is_named},
                              {"said", r.said},
                              {"vtkImageDifference", r.golden.vtk},
                              {"ssim", r.golden.ssim},
                              {"one_percent", r.golden.one_percent}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fathom::validation
