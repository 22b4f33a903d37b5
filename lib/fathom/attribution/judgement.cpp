#include "fathom/attribution/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/diagnosis.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_choice.h"
#include "fathom/attribution/other_scene.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

std::uint64_t unexplained(const Judgement& judgement) {
  return judgement.attribution.count(PixelClass::unexplained);
}

/// A reading of the size that needs a second fault, such as a shift by columns that it assumes
/// missing at the wrong side, is worse than a reading without a second fault.
bool explains_more(const Judgement& a, const Judgement& b) {
  const auto faults = [](const Judgement& judgement) {
    return std::pair(unexplained(judgement), judgement.attribution.findings.size());
  };
  return faults(a) < faults(b);
}

void set_trial(Judgement& judgement, ModelTrial trial) {
  judgement.model = std::move(trial.model);
  judgement.attribution = std::move(trial.attribution);
}

void judge_by_any(Judgement& judgement) {
  ModelChoice choice = chosen_model(*judgement.truth, judgement.other);
  set_trial(judgement, std::move(choice.chosen));
  judgement.attribution.notes.push_back(
      {.kind = "model",
       .text = "taken for " + judgement.model.name + ", the model that fits best",
       .pixels = judgement.attribution.classes.size(),
       .evidence = std::move(choice.evidence)});
}

/// Whether the narrowest model of a ray tracer was excluded from the choice, so that a depth buffer
/// may have drawn the map as well.
bool may_be_of_rasterizer(const Judgement& judgement) {
  return judgement.model.name != "float32-ray";
}

/// Models of rasterizers are meaningless without near and far: if pixels remain open or the model
/// is in doubt, a note says so.
void note_untried_models(Judgement& judgement, bool is_chosen) {
  const std::vector<Finding>& findings = judgement.attribution.findings;
  const bool is_in_doubt =
      unexplained(judgement) > 0 || (is_chosen && may_be_of_rasterizer(judgement)) ||
      std::any_of(findings.begin(), findings.end(),
                  [](const Finding& finding) { return finding.kind == "model"; });
  if (!is_in_doubt || has_clip_planes(judgement.truth->camera) || judgement.truth->lens) return;
  judgement.attribution.notes.push_back(
      {.kind = "model",
       .text =
           "no model of a rasterizer was tried: the camera has not both near and far; give those "
           "of the renderer, if it has a depth buffer",
       .pixels = unexplained(judgement)});
}

/// If pixels remain unexplained and no cause was found, another camera is the likely cause. The
/// bounds of a rasterizer's model follow from its near and far, too.
void note_clip_planes(Judgement& judgement) {
  const Camera& camera = judgement.truth->camera;
  const bool is_raster = std::holds_alternative<RasterModel>(judgement.model.kind);
  const bool is_open = unexplained(judgement) > 0 && judgement.attribution.findings.empty();
  if (!is_raster || !is_open || !has_clip_planes(camera)) return;
  judgement.attribution.notes.push_back(
      {.kind = "clip-planes",
       .text = fmt::format(
           "check that the map was drawn with this camera, and with its near {:.9g} and "
           "far {:.9g}, on which the model {} depends",
           camera.near, camera.far, judgement.model.name),
       .pixels = unexplained(judgement)});
}

/// A map whose only channel holds integers shows them as depths and as triangles.
std::string hint_of_codes(const OtherMap& other) {
  const bool is_one_channel = std::ranges::equal(other.values, other.triangles);
  return is_one_channel ? ", or a map of depths; codes of a depth buffer? decode them: in Python, "
                          "fathom.DepthFormat(...).decode(codes)"
                        : "";
}

/// Identifiers are indices of the scene's triangles from here on.
void require_known_triangles(const std::string& name, const OtherMap& other, const Scene& scene) {
  const std::uint64_t count = triangle_count(scene);
  for (const std::uint32_t triangle : other.triangles) {
    if (triangle == no_surface || triangle < count) continue;
    throw InputError(fmt::format(
        "{}: shows triangle {}, but the scene has {}; expected the SCENE that it was drawn from{}",
        name, triangle, count, hint_of_codes(other)));
  }
}

Judgement judge_of_camera(const OtherMap& other, const Scene& scene, const Camera& camera,
                          const std::optional<RendererModel>& model) {
  return judge(std::make_shared<Truth>(make_truth(scene, camera)), other, model);
}

/// Only by the named model, which suffices to distinguish readings of a size.
Judgement judge_reading(const SizedMap& sized, const Scene& scene,
                        const std::optional<RendererModel>& model) {
  auto truth = std::make_shared<const Truth>(make_truth(scene, sized.camera));
  if (!model) return judge(std::move(truth), sized.map, model);
  Judgement judgement{.model = *model, .truth = std::move(truth)};
  judgement.other = known_background(*judgement.truth, sized.map).map;
  judgement.model.sample.lens = judgement.truth->lens;
  judgement.attribution = attribute_and_name(*judgement.truth, sized.map, judgement.model);
  return judgement;
}

void name_size(Judgement& judgement, Finding finding) {
  finding.pixels = judgement.attribution.classes.size();
  std::vector<Finding>& findings = judgement.attribution.findings;
  findings.insert(findings.begin(), std::move(finding));
}

/// A map of another size is judged by the reading that explains it best, if this explains half of
/// it.
Judgement judge_other_size(const std::string& name, const OtherMap& other, const Scene& scene,
                           const Camera& camera, const std::optional<RendererModel>& model) {
  const std::vector<SizedMap> readings = readings_of_other_size(camera, other);
  std::optional<Judgement> best;
  const SizedMap* reading = nullptr;
  for (const SizedMap& sized : readings) {
    Judgement next = judge_reading(sized, scene, model);
    if (best && !explains_more(next, *best)) continue;
    best = std::move(next);
    reading = &sized;
  }
  if (best && model && unexplained(*best) > 0) best = judge(best->truth, reading->map, model);
  if (!best || unexplained(*best) * 2 > best->attribution.classes.size()) {
    throw InputError(fmt::format(
        "{}: has {}x{} pixels, the camera {}x{}; expected the camera that it was drawn with", name,
        other.width, other.height, camera.width, camera.height));
  }
  name_size(*best, reading->finding);
  return std::move(*best);
}

}  // namespace

RendererModel model_for(const std::string& name, const Camera& camera) {
  const StandardArithmetic standard;
  const Setting setting{"model"};
  try {
    RendererModel model = model_named(name);
    if (!std::holds_alternative<RayModel>(model.kind))
      require_straight(camera,
                       "a graphics pipeline draws straight edges; expected a model of "
                       "rays: float32-ray or cycles");
    if (has_clip_planes_for(model, camera)) return model;
  } catch (const UsageError& error) {
    throw UsageError(setting, error.what());
  }
  throw UsageError(setting, name +
                                " stores depths between near and far, and the camera has not both; "
                                "expected the renderer's values, as \"near\": 0.1, \"far\": 100");
}

Judgement judge(std::shared_ptr<const Truth> truth, const OtherMap& other,
                const std::optional<RendererModel>& model) {
  const StandardArithmetic standard;
  Judgement judgement{.truth = std::move(truth)};
  KnownBackground known = known_background(*judgement.truth, other);
  judgement.other = std::move(known.map);
  if (model) {
    RendererModel through_lens = *model;
    through_lens.sample.lens = judgement.truth->lens;
    set_trial(judgement, judged_by(*judgement.truth, judgement.other, through_lens));
  } else {
    judge_by_any(judgement);
  }
  if (known.note) judgement.attribution.notes.push_back(std::move(*known.note));
  note_untried_models(judgement, !model);
  note_clip_planes(judgement);
  return judgement;
}

Judgement judge_map(const std::string& name, const OtherMap& other, const Scene& scene,
                    const Camera& camera, const std::optional<RendererModel>& model) {
  const StandardArithmetic standard;
  require_known_triangles(name, other, scene);
  const bool has_size = other.width == camera.width && other.height == camera.height;
  Judgement judgement = has_size ? judge_of_camera(other, scene, camera, model)
                                 : judge_other_size(name, other, scene, camera, model);
  name_other_scene(camera, other, judgement);
  return judgement;
}

}  // namespace fathom::attribution
