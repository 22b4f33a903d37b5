#include "apps/validate/judge_brought.h"

#include <utility>

#include "apps/shell/about_option.h"
#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/background.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_choice.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using validation::ValidationCase;

void judge_by_any(ValidationCase& made) {
  attribution::ModelChoice choice = attribution::chosen_model(*made.truth, made.other);
  made.model = std::move(choice.chosen.model);
  made.attribution = std::move(choice.chosen.attribution);
  made.attribution.notes.push_back(
      {.kind = "model",
       .text = "taken for " + made.model.name + ", the model that fits best",
       .pixels = made.attribution.classes.size(),
       .evidence = std::move(choice.evidence)});
}

}  // namespace

attribution::RendererModel model_for(const std::string& model, const Camera& camera) {
  attribution::RendererModel found =
      about_option("--model", [&] { return attribution::model_named(model); });
  if (attribution::has_clip_planes_for(found, camera)) return found;
  throw UsageError("--model " + model +
                   ": the camera file has no near and far, between which its depths are stored; "
                   "expected those of the renderer in it, as \"near\": 0.1, \"far\": 100");
}

void judge_brought(const std::string& model, ValidationCase& made) {
  if (model != any_model) made.model = model_for(model, made.truth->camera);
  made.other = attribution::known_background(*made.truth, made.other).map;
  if (model == any_model) return judge_by_any(made);
  made.attribution = attribution::attribute_and_name(*made.truth, made.other, made.model);
}

}  // namespace fathom::app
