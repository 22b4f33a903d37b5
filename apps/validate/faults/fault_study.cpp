#include "apps/validate/faults/fault_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/robust_statistics.h"
#include "fathom/text/counted.h"

namespace fathom::validation {
namespace {

using attribution::Attribution;
using attribution::Finding;
using attribution::OtherMap;
using attribution::PixelClass;

constexpr double infinity = std::numeric_limits<double>::infinity();

OtherMap exact_map_of(const attribution::Truth& truth) {
  OtherMap map{.width = truth.camera.width, .height = truth.camera.height};
  map.depths = truth.depths;
  map.values = truth.depths;
  return map;
}

double effect_between(const Attribution& found, const OtherMap& before_map,
                      const OtherMap& after_map) {
  std::vector<double> effects;
  for (std::size_t i = 0; i < after_map.depths.size(); ++i) {
    const double before = before_map.depths[i], after = after_map.depths[i];
    if (before == after || (std::isinf(before) && std::isinf(after))) continue;
    const double half_width = (double{found.greatest[i]} - found.least[i]) / 2;
    const bool is_surface = before < infinity && std::abs(after) < infinity;
    if (is_surface && !(half_width < infinity)) continue;  // nothing is allowed or forbidden here
    effects.push_back(is_surface ? std::abs(after - before) / half_width : infinity);
  }
  return effects.empty() ? 0 : attribution::median_of(effects);
}

double effect_of_size(const Fault& fault, const FaultSubject& subject, double size) {
  if (!fault.drawn) return effect_of(subject, changed_map(fault, subject, size));
  // Compared with the exact map, because the renderer's roundings are not part of the fault.
  return effect_between(subject.found, exact_map_of(subject.truth),
                        exact_map_of(fault.drawn(subject.scene, size)));
}

bool is_kind(const Fault& fault, const std::string& kind) {
  return std::find(fault.kinds.begin(), fault.kinds.end(), kind) != fault.kinds.end();
}

bool names(const Fault& fault, const Finding& finding) {
  return is_kind(fault, finding.kind) ||
         std::any_of(finding.alternatives.begin(), finding.alternatives.end(),
                     [&](const std::string& kind) { return is_kind(fault, kind); });
}

}  // namespace

OtherMap exact_map_of(const ValidationScene& scene) {
  return exact_map_of(attribution::make_truth(scene.scene, scene.camera));
}

OtherMap as_brought(const OtherMap& drawn) {
  OtherMap map{.width = drawn.width, .height = drawn.height};
  for (const double depth : drawn.depths) {
    map.depths.push_back(static_cast<double>(static_cast<float>(depth)));
  }
  map.values = map.depths;
  return map;
}

FaultSubject fault_subject(const ValidationScene& scene, const OtherMap& drawn,
                           const attribution::RendererModel& model) {
  FaultSubject subject{scene, attribution::make_truth(scene.scene, scene.camera), {}, model, {}};
  subject.map = as_brought(drawn);
  subject.found = attribution::attribute_and_name(subject.truth, subject.map, model);
  return subject;
}

double effect_of(const FaultSubject& subject, const OtherMap& map) {
  return effect_between(subject.found, subject.map, map);
}

std::vector<double> sizes_of(const Fault& fault, const FaultSubject& subject) {
  if (!fault.has_size()) return {0};
  std::vector<double> sizes;
  double size = fault.probe;
  for (const double target : {1.0, 3.0, 10.0, 100.0}) {
    // Nearly proportional: silhouettes and steps bend it.
    for (int round = 0; round < 6; ++round) {
      const double effect = effect_of_size(fault, subject, size);
      if (effect > 0.95 * target && effect < 1.1 * target) break;
      size *= effect > 0 ? std::clamp(1.02 * target / effect, 0.01, 100.0) : 10;
    }
    sizes.push_back(size);
  }
  return sizes;
}

OtherMap changed_map(const Fault& fault, const FaultSubject& subject, double size) {
  OtherMap map = subject.map;
  fault.changed(map, {subject.truth, subject.map}, size);
  return map;
}

FaultResult judged(const Fault& fault, const FaultSubject& subject, const OtherMap& map,
                   double size) {
  FaultResult result{.size = size, .effect = effect_of(subject, map)};
  const Attribution found = attribution::attribute_and_name(subject.truth, map, subject.model);
  const bool is_noted = std::any_of(found.notes.begin(), found.notes.end(),
                                    [&](const Finding& f) { return is_kind(fault, f.kind); });
  result.is_found = found.count(PixelClass::unexplained) > 0 || !found.findings.empty() || is_noted;
  result.is_named = is_noted || (!found.findings.empty() && names(fault, found.findings.front()));
  const std::vector<Finding>& said = is_noted ? found.notes : found.findings;
  if (!said.empty()) result.said = said.front().kind + ": " + said.front().text;
  result.golden = golden_verdicts(subject.map, map, subject.scene.camera);
  return result;
}

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
