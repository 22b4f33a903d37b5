#include "apps/validate/faults/fault_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/attribution/attribution.h"

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
  if (effects.empty()) return 0;
  const auto middle = effects.begin() + static_cast<std::ptrdiff_t>(effects.size() / 2);
  std::nth_element(effects.begin(), middle, effects.end());
  return *middle;
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

}  // namespace fathom::validation
