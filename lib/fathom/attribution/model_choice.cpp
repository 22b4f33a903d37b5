#include "fathom/attribution/model_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "fathom/attribution/diagnosis.h"
#include "fathom/attribution/faults/storage.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_survey.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

// How to read this file: chosen_model() and judged_by() at the end. A sample of rows excludes most
// models; the remaining models judge all pixels one by one.
namespace fathom::attribution {
namespace {

std::uint64_t unexplained(const Attribution& found) {
  return found.count(PixelClass::unexplained);
}

bool explains_all(const Attribution& found) {
  return unexplained(found) == 0 && found.findings.empty() && found.sharpness.decides();
}

/// Whether bounds that exclude nearly nothing contain the map. That is no evidence for it.
bool is_undecided(const Attribution& found) {
  return unexplained(found) == 0 && !found.sharpness.decides();
}

/// Whether narrow bounds show a cause of all that is wrong. Bounds wider than the depth, such as
/// coarse codes far from the eye, may contain what remains after a wrong cause.
bool names_cause(const Attribution& found) {
  return unexplained(found) == 0 && !found.findings.empty() && found.sharpness.decides() &&
         found.sharpness.median_relative_width < 1;
}

/// Whether the map shows surfaces but no depth could be compared: every pixel of them may be an
/// edge, for example because a huge triangle passes the eye. Then nearly any map would be
/// explained.
bool is_vacuous(const Attribution& found, const OtherMap& other) {
  return found.sharpness.median_relative_width == 0 &&
         std::any_of(other.depths.begin(), other.depths.end(),
                     [](double depth) { return std::isfinite(depth); });
}

/// A lower rank is better.
auto rank(const Attribution& found) {
  return std::tuple(!found.sharpness.decides(), unexplained(found), found.findings.size(),
                    found.sharpness.median_relative_width);
}

std::string text_of(const ModelTrial& trial) {
  const Attribution& found = trial.attribution;
  const std::string bounds =
      fmt::format("bounds {:.2g} of the depth", found.sharpness.median_relative_width);
  if (explains_all(found)) return trial.model.name + ": every pixel is explained, " + bounds;
  if (is_undecided(found)) return trial.model.name + ": cannot tell, nearly any depth is allowed";
  return fmt::format("{}: {} unexplained, {}, {}", trial.model.name,
                     text::counted(unexplained(found), "pixel"),
                     text::counted(found.findings.size(), "finding"), bounds);
}

/// A model after a fault has been corrected, such as other sample positions or another recording of
/// depths.
RendererModel put_right(RendererModel model, const Hypothesis& h) {
  model.recorded = h.model.recorded;
  model.sample.x = h.model.sample.x;
  model.sample.y = h.model.sample.y;
  model.sample.k1 = h.model.sample.k1;
  model.sample.k2 = h.model.sample.k2;
  model.sample.lens = h.model.sample.lens;
  const auto* const from = std::get_if<RasterModel>(&h.model.kind);
  auto* const raster = std::get_if<RasterModel>(&model.kind);
  if (raster != nullptr) raster->affine = from != nullptr && from->affine;
  return model;
}

/// The named models that may have drawn a map of the truth's camera.
std::vector<RendererModel> models_for(const Truth& truth) {
  std::vector<RendererModel> models;
  for (RendererModel& model : named_models()) {
    if (!has_clip_planes_for(model, truth.camera)) continue;
    if (truth.lens && !std::holds_alternative<RayModel>(model.kind)) continue;
    model.sample.lens = truth.lens;
    models.push_back(std::move(model));
  }
  return models;
}

/// The models that may have drawn a map, except one.
class Candidates {
 public:
  Candidates(const Truth& truth, const OtherMap& other, std::string except)
      : truth_(truth), other_(other), except_(std::move(except)) {}

  /// The model with the narrowest bounds that explains the map; a model of VTK only if no other
  /// model explains it.
  std::optional<ModelTrial> explaining();
  /// The same among VTK's models only.
  std::optional<ModelTrial> explaining_of_vtk() { return explaining(true); }
  /// The first model that explains the map with bounds that exclude nearly nothing. Call after
  /// explaining().
  [[nodiscard]] std::optional<ModelTrial> undecided() const;
  /// Faults of a map that no model explains, by the model that fits best. Call after
  /// explaining().
  std::optional<ModelTrial> at_fault();
  [[nodiscard]] std::vector<std::string> evidence() const;
  /// ", perhaps also as gl-unorm24, gl-float32": other models whose sample is explained.
  [[nodiscard]] std::string text_of_others(const RendererModel& chosen) const;

 private:
  std::optional<ModelTrial> explaining(bool of_vtk);
  /// The last trial of the survey's model on the whole map.
  [[nodiscard]] const ModelTrial* trial_of(const ModelSurvey& survey) const;
  [[nodiscard]] double left_by(const ModelSurvey& survey) const;
  [[nodiscard]] std::vector<ModelSurvey> by_what_they_leave() const;
  std::optional<ModelTrial> with_stored_planes();
  [[nodiscard]] ModelTrial diagnosed(const RendererModel& model, std::optional<Hypothesis>& fault);
  [[nodiscard]] std::vector<RendererModel> narrowest_after(const Hypothesis& fault) const;

  const Truth& truth_;
  const OtherMap& other_;
  std::string except_;
  std::vector<ModelSurvey> surveys_;
  std::vector<ModelTrial> trials_;
};

std::optional<ModelTrial> Candidates::explaining(bool of_vtk) {
  std::vector<ModelSurvey> possible;
  for (const RendererModel& model : models_for(truth_)) {
    if (is_of_vtk(model) != of_vtk || model.name == except_) continue;
    surveys_.push_back(surveyed(truth_, other_, model));
    if (surveys_.back().may_explain_all()) possible.push_back(surveys_.back());
  }
  std::stable_sort(possible.begin(), possible.end(),
                   [](const ModelSurvey& a, const ModelSurvey& b) {
                     // Without a width no depth of the sample was compared: the least evidence.
                     return std::pair(a.width == 0, a.width) < std::pair(b.width == 0, b.width);
                   });
  for (const ModelSurvey& survey : possible) {
    const RendererModel known = as_recorded(survey.model, other_);
    Attribution found = attribute(truth_, other_, known);
    if (unexplained(found) == 0) {
      found = diagnose(truth_, other_, known, std::move(found)).attribution;
    }
    trials_.push_back({survey.model, std::move(found)});
    if (explains_all(trials_.back().attribution)) return trials_.back();
  }
  return std::nullopt;
}

std::optional<ModelTrial> Candidates::explaining() {
  for (const bool of_vtk : {false, true}) {
    if (auto trial = explaining(of_vtk)) return trial;
  }
  return std::nullopt;
}

std::optional<ModelTrial> Candidates::undecided() const {
  const auto trial = std::find_if(trials_.begin(), trials_.end(), [](const ModelTrial& t) {
    return is_undecided(t.attribution) && t.attribution.findings.empty();
  });
  return trial == trials_.end() ? std::nullopt : std::optional(*trial);
}

const ModelTrial* Candidates::trial_of(const ModelSurvey& survey) const {
  const auto trial = std::find_if(trials_.rbegin(), trials_.rend(), [&](const ModelTrial& t) {
    return t.model.name == survey.model.name;
  });
  return trial == trials_.rend() ? nullptr : &*trial;
}

/// Unexplained pixels of the whole map: counted after a trial, else estimated.
double Candidates::left_by(const ModelSurvey& survey) const {
  const ModelTrial* const trial = trial_of(survey);
  return trial == nullptr ? survey.estimated_unexplained()
                          : static_cast<double>(unexplained(trial->attribution));
}

/// Models that decide something first. Of these, fewest open pixels first; among equals the widest
/// bounds first, because they leave only gross faults.
std::vector<ModelSurvey> Candidates::by_what_they_leave() const {
  std::vector<ModelSurvey> sorted = surveys_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const ModelSurvey& a, const ModelSurvey& b) {
    return std::tuple(!a.decides, left_by(a), -a.width) <
           std::tuple(!b.decides, left_by(b), -b.width);
  });
  return sorted;
}

ModelTrial Candidates::diagnosed(const RendererModel& model, std::optional<Hypothesis>& fault) {
  const RendererModel known = as_recorded(model, other_);
  Diagnosis diagnosis = diagnose(truth_, other_, known, attribute(truth_, other_, known));
  fault = std::move(diagnosis.put_right);
  ModelTrial trial{model, std::move(diagnosis.attribution)};
  trials_.push_back(trial);
  return trial;
}

/// The models with the narrowest bounds among those that explain a sample of the corrected map.
std::vector<RendererModel> Candidates::narrowest_after(const Hypothesis& fault) const {
  std::vector<std::pair<double, RendererModel>> possible;
  const Truth& truth = fault.truth ? *fault.truth : truth_;
  for (const ModelSurvey& survey : surveys_) {
    const ModelSurvey after = surveyed(truth, fault.map, put_right(survey.model, fault));
    if (after.may_explain_all()) possible.emplace_back(after.width, survey.model);
  }
  std::stable_sort(possible.begin(), possible.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<RendererModel> models;
  models.reserve(possible.size());
  for (auto& [width, model] : possible) models.push_back(std::move(model));
  return models;
}

/// By a model whose codes the depths are, with another near and far.
std::optional<ModelTrial> Candidates::with_stored_planes() {
  for (const ModelSurvey& survey : surveys_) {
    if (!stored_planes(truth_.camera, other_, survey.model)) continue;
    std::optional<Hypothesis> fault;
    ModelTrial trial = diagnosed(survey.model, fault);
    if (names_cause(trial.attribution)) return trial;
  }
  return std::nullopt;
}

std::optional<ModelTrial> Candidates::at_fault() {
  std::optional<ModelTrial> best = with_stored_planes();
  if (best) return best;
  std::array<bool, 2> is_tried{};  // rasterizers, rays
  for (const ModelSurvey& survey : by_what_they_leave()) {
    if (std::exchange(is_tried[survey.model.kind.index()], true)) continue;
    std::optional<Hypothesis> fault;
    ModelTrial trial = diagnosed(survey.model, fault);
    if (!best || rank(trial.attribution) < rank(best->attribution)) best = trial;
    if (!fault) continue;
    constexpr std::size_t most = 2;
    std::size_t tries = 0;
    for (const RendererModel& model : narrowest_after(*fault)) {
      if (model.name == best->model.name || ++tries > most) break;
      std::optional<Hypothesis> same;
      ModelTrial next = diagnosed(model, same);
      if (rank(next.attribution) < rank(best->attribution)) best = next;
      if (unexplained(next.attribution) == 0) break;
    }
    if (unexplained(best->attribution) == 0 && best->attribution.sharpness.decides()) break;
  }
  return best;
}

/// Models that judged every pixel come first, with the line of that trial.
std::vector<std::string> Candidates::evidence() const {
  std::vector<std::string> lines, of_samples;
  for (const ModelSurvey& survey : surveys_) {
    const ModelTrial* const trial = trial_of(survey);
    if (trial != nullptr) {
      lines.push_back(text_of(*trial));
    } else {
      of_samples.push_back(attribution::text_of(survey));
    }
  }
  lines.insert(lines.end(), of_samples.begin(), of_samples.end());
  return lines;
}

std::string Candidates::text_of_others(const RendererModel& chosen) const {
  std::string names;
  for (const ModelSurvey& survey : surveys_) {
    if (!survey.may_explain_all() || survey.model.name == chosen.name) continue;
    names += (names.empty() ? ", perhaps also as " : ", ") + survey.model.name;
  }
  return names;
}

/// Whether a surface is unexplained; holes do not count, because wider bounds do not explain them.
bool shows_surfaces_where_open(const Attribution& found, const OtherMap& other) {
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    if (found.classes[i] == PixelClass::unexplained && std::isfinite(other.depths[i])) return true;
  }
  return false;
}

/// Greatest ratio of another model's bounds to the named model's bounds with which the other model
/// may explain a fault that the named model finds: wide bounds explain much. Faults of positions in
/// the image have no such limit: if another model explains them, they are as small as a camera's
/// roundings.
double widest_for(const Attribution& mine, const OtherMap& other) {
  const std::string_view kind = mine.findings.empty() ? "" : mine.findings.front().kind;
  if (kind == "isolated-pixels" && shows_surfaces_where_open(mine, other)) return 10;
  const bool is_of_depths = kind == "scale" || kind == "decoding" || kind == "bias";
  return is_of_depths && unexplained(mine) == 0 ? 2 : std::numeric_limits<double>::infinity();
}

/// Whether the named model's findings precede another model that explains everything.
bool comes_before(const Attribution& mine, const Attribution& right, const OtherMap& other) {
  return right.sharpness.median_relative_width >
         widest_for(mine, other) * mine.sharpness.median_relative_width;
}

bool has_storage(const Attribution& found) {
  return std::any_of(found.findings.begin(), found.findings.end(),
                     [](const Finding& finding) { return finding.kind == "storage"; });
}

/// Whether a fault with another model is better than the named model's findings: it leaves at most
/// a tenth of the pixels, or no pixel with fewer findings if the named model also needs a storage.
bool says_more(const Attribution& best, const Attribution& mine) {
  if (unexplained(mine) > 0) return unexplained(best) * 10 <= unexplained(mine);
  return unexplained(best) == 0 && best.findings.size() < mine.findings.size();
}

std::string text_of_fit(const Attribution& found) {
  if (explains_all(found)) return "every pixel is explained";
  return unexplained(found) == 0 ? "the fault explains every pixel"
                                 : "fewer pixels are unexplained";
}

/// `pixels`: the number of pixels that the named model leaves open.
void name_model(ModelTrial& trial, const RendererModel& named, std::uint64_t pixels,
                const Candidates& candidates) {
  trial.attribution.findings.push_back(
      {.kind = "model",
       .text = fmt::format(
           "the model {} does not fit: as {} {}{}; give the model {}", named.name, trial.model.name,
           text_of_fit(trial.attribution),
           explains_all(trial.attribution) ? candidates.text_of_others(trial.model) : "",
           trial.model.name),
       .pixels = pixels,
       .evidence = candidates.evidence()});
}

/// Bounds that exclude nearly nothing were asked for, and another model's bounds acquit the map.
void note_narrower_model(ModelTrial& right, const RendererModel& named) {
  right.attribution.notes.push_back(
      {.kind = "model",
       .text =
           fmt::format("as {} nearly any depth is allowed; judged as {}, within narrower bounds",
                       named.name, right.model.name),
       .pixels = right.attribution.classes.size()});
}

/// The other model explains everything, but its bounds are too wide to acquit the map.
void name_wider_model(ModelTrial& mine, const ModelTrial& wider, const Candidates& candidates) {
  Finding& fault = mine.attribution.findings.front();
  fault.alternatives.emplace_back("model");
  fault.text += fmt::format(
      "; or the model {} does not fit: as {} every pixel is explained{}, within wider bounds",
      mine.model.name, wider.model.name, candidates.text_of_others(wider.model));
}

/// Only bounds that exclude nearly nothing explain the map: the named model does not fit, and
/// whether the map is right remains open.
void name_undecided_model(ModelTrial& wide, const RendererModel& named, std::uint64_t pixels,
                          const std::vector<Finding>& faults, const Candidates& candidates) {
  Finding finding{.kind = "model",
                  .text = fmt::format(
                      "the model {} does not fit: as {} every pixel is explained, but nearly "
                      "any depth is allowed; give the near, the far and the model of the renderer",
                      named.name, wide.model.name),
                  .pixels = pixels,
                  .evidence = candidates.evidence()};
  if (!faults.empty()) finding.alternatives.push_back(faults.front().kind);
  wide.attribution.findings.push_back(std::move(finding));
}

/// The verdict of bounds that exclude nearly nothing.
Finding undecided_by(const ModelTrial& trial, const Truth& truth) {
  const auto surfaces =
      truth.triangles.size() - static_cast<std::size_t>(std::count(
                                   truth.triangles.begin(), truth.triangles.end(), no_surface));
  const double loose = trial.attribution.sharpness.loose_share * static_cast<double>(surfaces);
  return {.kind = "undecided",
          .text = fmt::format(
              "cannot tell: as {} every pixel is explained, but nearly any depth is allowed",
              trial.model.name),
          .pixels = static_cast<std::uint64_t>(std::llround(loose))};
}

/// The verdict of a named model that allows nearly any depth and explains every pixel: the verdict
/// of a narrower model that explains them, too. Otherwise a note, which names a fault that explains
/// them by a narrower model, if there is one.
ModelTrial judged_by_wide_bounds(const Truth& truth, const OtherMap& other, ModelTrial mine) {
  Candidates candidates(truth, other, mine.model.name);
  std::optional<ModelTrial> right = candidates.explaining();
  if (right && !is_vacuous(right->attribution, other)) {
    note_narrower_model(*right, mine.model);
    return std::move(*right);
  }
  Finding note = undecided_by(mine, truth);
  const std::optional<ModelTrial> best = candidates.at_fault();
  if (best && names_cause(best->attribution)) {
    note.text += fmt::format("; as {} a fault explains every pixel: {}", best->model.name,
                             best->attribution.findings.front().text);
  }
  mine.attribution.notes.push_back(std::move(note));
  return mine;
}

}  // namespace

ModelChoice chosen_model(const Truth& truth, const OtherMap& other) {
  const StandardArithmetic standard;
  Candidates candidates(truth, other, "");
  std::optional<ModelTrial> chosen = candidates.explaining();
  if (!chosen) chosen = candidates.at_fault();
  if (!explains_all(chosen->attribution) && !names_cause(chosen->attribution)) {
    if (std::optional<ModelTrial> undecided = candidates.undecided()) {
      chosen = std::move(undecided);
      Finding finding = undecided_by(*chosen, truth);
      finding.text += "; give the near, the far and the model of the renderer";
      chosen->attribution.findings.push_back(std::move(finding));
    }
  }
  return {std::move(*chosen), candidates.evidence()};
}

ModelTrial judged_by(const Truth& truth, const OtherMap& other, const RendererModel& named) {
  const StandardArithmetic standard;
  const RendererModel known = as_recorded(named, other);
  Attribution found = attribute(truth, other, known);
  const std::uint64_t open = unexplained(found);
  // Causes that bounds which exclude nearly nothing show are none.
  if (open == 0 || found.sharpness.decides()) {
    found = diagnose(truth, other, known, std::move(found)).attribution;
  }
  ModelTrial mine{named, std::move(found)};
  if (explains_all(mine.attribution)) return mine;
  if (is_undecided(mine.attribution)) return judged_by_wide_bounds(truth, other, std::move(mine));
  std::vector<Finding>& faults = mine.attribution.findings;
  const bool is_named = names_cause(mine.attribution);

  Candidates candidates(truth, other, named.name);
  const auto has_too_wide_bounds = [&](const ModelTrial& trial) {
    return comes_before(mine.attribution, trial.attribution, other);
  };
  std::optional<ModelTrial> right = candidates.explaining();
  if (right && !is_vacuous(right->attribution, other)) {
    if (has_too_wide_bounds(*right) && !is_of_vtk(right->model)) {
      // Where coordinates are large, VTK's shift narrows the bounds of the same storage.
      std::optional<ModelTrial> shifted = candidates.explaining_of_vtk();
      const bool is_better =
          shifted && !is_vacuous(shifted->attribution, other) && !has_too_wide_bounds(*shifted);
      if (is_better) right = std::move(shifted);
    }
    if (has_too_wide_bounds(*right)) {
      name_wider_model(mine, *right, candidates);
      return mine;
    }
    name_model(*right, named, open, candidates);
    // A storage is part of a model.
    if (is_named && faults.front().kind != "storage") {
      right->attribution.findings.front().alternatives.push_back(faults.front().kind);
    }
    return std::move(*right);
  }
  if (is_named && !(faults.size() > 1 && has_storage(mine.attribution))) return mine;
  std::optional<ModelTrial> best = candidates.at_fault();
  if (!is_named && !(best && names_cause(best->attribution))) {
    if (std::optional<ModelTrial> wide = candidates.undecided()) {
      name_undecided_model(*wide, named, open, faults, candidates);
      return std::move(*wide);
    }
  }
  if (!best || is_vacuous(best->attribution, other)) return mine;
  if (!best->attribution.sharpness.decides()) return mine;
  if (!says_more(best->attribution, mine.attribution)) return mine;
  name_model(*best, named, open, candidates);
  return std::move(*best);
}

}  // namespace fathom::attribution
