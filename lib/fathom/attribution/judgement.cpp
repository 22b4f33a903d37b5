#include "fathom/attribution/judgement.h"

#include <fmt/format.h>

#include <utility>

#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/background.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_choice.h"
#include "fathom/attribution/other_scene.h"
#include "fathom/attribution/other_size.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

std::uint64_t unexplained(const Judgement& judgement) {
  return judgement.attribution.count(PixelClass::unexplained);
}

/// A reading of the size that needs another fault beside it, such as a shift by the columns that it
/// takes for missing at the wrong side, explains less than one that needs none.
bool explains_more(const Judgement& a, const Judgement& b) {
  const auto faults = [](const Judgement& judgement) {
    return std::pair(unexplained(judgement), judgement.attribution.findings.size());
  };
  return faults(a) < faults(b);
}

void judge_by_any(Judgement& judgement) {
  ModelChoice choice = chosen_model(*judgement.truth, judgement.other);
  judgement.model = std::move(choice.chosen.model);
  judgement.attribution = std::move(choice.chosen.attribution);
  judgement.attribution.notes.push_back(
      {.kind = "model",
       .text = "taken for " + judgement.model.name + ", the model that fits best",
       .pixels = judgement.attribution.classes.size(),
       .evidence = std::move(choice.evidence)});
}

/// Identifiers are indices of the scene's triangles from here on.
void require_known_triangles(const std::string& name, const OtherMap& other, const Scene& scene) {
  const std::uint64_t count = triangle_count(scene);
  for (const std::uint32_t triangle : other.triangles) {
    if (triangle == no_surface || triangle < count) continue;
    throw InputError(fmt::format(
        "{}: shows triangle {}, but the scene has {}; expected the SCENE that it was drawn from",
        name, triangle, count));
  }
}

Judgement judge_of_camera(const OtherMap& other, const Scene& scene, const Camera& camera,
                          const std::optional<RendererModel>& model) {
  return judge(std::make_shared<Truth>(make_truth(scene, camera)), other, model);
}

/// A map of another size is judged as what explains it best, if that explains half of it.
Judgement judge_other_size(const std::string& name, const OtherMap& other, const Scene& scene,
                           const Camera& camera, const std::optional<RendererModel>& model) {
  std::optional<Judgement> best;
  for (const SizedMap& sized : readings_of_other_size(camera, other)) {
    Judgement next = judge_of_camera(sized.map, scene, sized.camera, model);
    Finding finding = sized.finding;
    finding.pixels = next.attribution.classes.size();
    next.attribution.findings.insert(next.attribution.findings.begin(), std::move(finding));
    if (!best || explains_more(next, *best)) best = std::move(next);
  }
  if (!best || unexplained(*best) * 2 > best->attribution.classes.size()) {
    throw InputError(fmt::format(
        "{}: has {}x{} pixels, the camera {}x{}; expected the camera that it was drawn with", name,
        other.width, other.height, camera.width, camera.height));
  }
  return std::move(*best);
}

}  // namespace

RendererModel model_for(const std::string& name, const Camera& camera) {
  const StandardArithmetic standard;
  const Setting setting{"model"};
  try {
    RendererModel model = model_named(name);
    if (has_clip_planes_for(model, camera)) return model;
  } catch (const UsageError& error) {
    throw UsageError(setting, error.what());
  }
  throw UsageError(setting, name +
                                " stores depths between near and far, and the camera has not both; "
                                "expected those of the renderer, as \"near\": 0.1, \"far\": 100");
}

Judgement judge(std::shared_ptr<const Truth> truth, const OtherMap& other,
                const std::optional<RendererModel>& model) {
  const StandardArithmetic standard;
  Judgement judgement{.truth = std::move(truth)};
  judgement.other = known_background(*judgement.truth, other).map;
  if (!model) {
    judge_by_any(judgement);
    return judgement;
  }
  judgement.model = *model;
  judgement.attribution = attribute_and_name(*judgement.truth, judgement.other, *model);
  return judgement;
}

Judgement judge_map(const std::string& name, const OtherMap& other, const Scene& scene,
                    const Camera& camera, const std::optional<RendererModel>& model) {
  const StandardArithmetic standard;
  require_known_triangles(name, other, scene);
  const bool has_size = other.width == camera.width && other.height == camera.height;
  Judgement judgement = has_size ? judge_of_camera(other, scene, camera, model)
                                 : judge_other_size(name, other, scene, camera, model);
  name_other_scene(judgement);
  return judgement;
}

}  // namespace fathom::attribution
