#include "fathom/attribution/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/depth_relation.h"
#include "fathom/attribution/faults/deviation_fit.h"
#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/attribution/faults/interpolated_lookup.h"
#include "fathom/attribution/faults/local_faults.h"
#include "fathom/attribution/faults/storage.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/numeric/standard_arithmetic.h"

// How to read this file: known_background() separates the background from surfaces. For the search
// for faults, start with attribute_and_name() at the end. Faults are tried from the simplest to the
// most complex, and the first fault that explains nine tenths of the unexplained pixels is taken.
namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Number and share of the empty pixels that must agree.
constexpr std::uint64_t least_pixels = 16;
constexpr double least_share = 0.5;

/// Whether neither the pixel nor any of its neighbours shows a surface.
bool is_clear(const Truth& truth, std::uint32_t column, std::uint32_t row) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  for (std::uint32_t y = row == 0 ? 0 : row - 1; y <= row + 1 && y < height; ++y) {
    for (std::uint32_t x = column == 0 ? 0 : column - 1; x <= column + 1 && x < width; ++x) {
      if (truth.triangles[std::size_t{y} * width + x] != no_surface) return false;
    }
  }
  return true;
}

/// How often each value stands where nothing is seen; NaN counts as one value.
struct Census {
  std::unordered_map<double, std::uint64_t> counts;
  std::uint64_t nan = 0, total = 0;
};

Census census_of(const Truth& truth, const OtherMap& other) {
  Census census;
  for (std::uint32_t y = 0; y < truth.camera.height; ++y) {
    for (std::uint32_t x = 0; x < truth.camera.width; ++x) {
      if (!is_clear(truth, x, y)) continue;
      const double value = other.values[std::size_t{y} * truth.camera.width + x];
      ++census.total;
      std::isnan(value) ? ++census.nan : ++census.counts[value];
    }
  }
  return census;
}

/// The background's value, if most agree on it.
std::optional<double> agreed(const Census& census) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t most = census.nan;
  for (const auto& [v, count] : census.counts) {
    if (count > most || (count == most && v < value)) {
      value = v;
      most = count;
    }
  }
  const bool enough = most >= least_pixels &&
                      static_cast<double>(most) >= least_share * static_cast<double>(census.total);
  return enough ? std::optional(value) : std::nullopt;
}

/// "0", "NaN", "100, the depth of the far plane".
std::string described(double value, const Camera& camera) {
  if (std::isnan(value)) return "NaN";
  std::string text = fmt::format("{:.9g}", value);
  if (camera.far < infinity && std::abs(value - camera.far) <= 1e-5 * camera.far) {
    return text + ", the depth of the far plane";
  }
  if (value == double{std::numeric_limits<float>::max()}) return text + ", the greatest binary32";
  return text;
}

}  // namespace

KnownBackground known_background(const Truth& truth, const OtherMap& other) {
  const StandardArithmetic standard;
  KnownBackground known{other, std::nullopt};
  if (other.values.size() != truth.depths.size()) return known;
  const std::optional<double> value = agreed(census_of(truth, other));
  if (!value) return known;
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    const double v = other.values[i];
    const bool is_background = v == *value || !std::isfinite(v);
    known.map.depths[i] = is_background ? infinity : v;
    pixels += is_background ? 1 : 0;
  }
  if (*value != infinity) {
    known.note = Finding{
        "background",
        fmt::format("the background is stored as {}", described(*value, truth.camera)), pixels};
  }
  return known;
}

namespace {

/// 1 for each pixel that is explained.
std::vector<std::uint8_t> explained_by(const Attribution& found) {
  std::vector<std::uint8_t> explained;
  for (const PixelClass c : found.classes) {
    explained.push_back(c == PixelClass::unexplained ? 0 : 1);
  }
  return explained;
}

/// Whether so many pixels are too many for a hypothesis to leave unexplained.
bool leaves_too_many(std::uint64_t left, std::uint64_t before) {
  return left * 10 > before;
}

/// The bands with the most unexplained pixels, as few as hold a fifth of them: a hypothesis that
/// leaves more than half of these is refuted without a look at the rest of the image.
std::vector<std::uint32_t> telling_bands(const Attribution& found, std::uint32_t width) {
  const std::size_t size = std::size_t{width} * rows_per_band;
  std::vector<std::uint64_t> open((found.classes.size() + size - 1) / size);
  for (std::size_t i = 0; i < found.classes.size(); ++i)
    open[i / size] += found.classes[i] == PixelClass::unexplained ? 1 : 0;
  std::vector<std::uint32_t> bands(open.size());
  std::iota(bands.begin(), bands.end(), 0U);
  std::stable_sort(bands.begin(), bands.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return open[a] > open[b]; });
  std::uint64_t held = 0;
  std::size_t count = 0;
  while (count < bands.size() && held * 5 < found.count(PixelClass::unexplained))
    held += open[bands[count++]];
  bands.resize(count);
  return bands;
}

/// The first trial that leaves no pixel unexplained, otherwise the trial that leaves the fewest; of
/// hypotheses that explain nine tenths.
class BestTrial {
 public:
  /// `searched`: what the hypotheses are to explain.
  BestTrial(const Truth& truth, const Attribution& searched)
      : truth_(truth),
        unexplained_(searched.count(PixelClass::unexplained)),
        fewest_(unexplained_ + 1),
        bands_(telling_bands(searched, truth.camera.width)) {}

  void add(const Hypothesis& h) {
    if (is_perfect()) return;
    const Truth& truth = h.truth ? *h.truth : truth_;
    const auto left_in = [](const Attribution& found) {
      return found.count(PixelClass::unexplained);
    };
    if (leaves_too_many(left_in(attribute_bands(truth, h.map, h.model, bands_)), unexplained_))
      return;
    const Attribution found = attribute(truth, h.map, h.model);
    const std::uint64_t left = left_in(found);
    if (leaves_too_many(left, unexplained_) || left >= fewest_) return;
    fewest_ = left;
    explained_ = explained_by(found);
    best_ = h;
  }
  [[nodiscard]] bool is_perfect() const { return fewest_ == 0; }
  [[nodiscard]] bool has_one() const { return best_.has_value(); }
  [[nodiscard]] const Hypothesis& hypothesis() const { return *best_; }
  [[nodiscard]] Finding finding() const {
    return {best_->kind, best_->text, unexplained_ - fewest_, best_->estimates,
            best_->alternatives};
  }
  [[nodiscard]] const std::vector<std::uint8_t>& explained() const { return explained_; }

 private:
  const Truth& truth_;
  std::uint64_t unexplained_, fewest_;
  std::vector<std::uint32_t> bands_;
  std::vector<std::uint8_t> explained_;
  std::optional<Hypothesis> best_;
};

class Search {
 public:
  Search(const Truth& truth, const OtherMap& other, const RendererModel& model, Attribution found)
      : truth_(truth), other_(other), model_(model), found_(std::move(found)), searched_(found_) {}

  /// Searches for faults until most pixels are explained.
  void run();
  [[nodiscard]] Diagnosis result() && { return {std::move(found_), std::move(put_right_)}; }

 private:
  /// Assumes a coarse storage from here on, because the values themselves prove it.
  void name_storage();
  /// Each of these adds its findings and returns whether it found something.
  bool by_stored_planes();
  bool by_triangles();
  bool by_hypotheses();
  bool by_lookup();
  bool by_relations(bool excluding_camera);
  bool by_deviation();
  bool by_curve();
  bool by_pixels();

  void add_drawn_planes(BestTrial& best) const;
  [[nodiscard]] const std::vector<DepthRelation>& relations();
  void name(const Finding& finding, const std::vector<std::uint8_t>& explained);
  void name(const BestTrial& trial);
  void name_bias();
  void name_what_is_within_bounds();

  [[nodiscard]] std::uint64_t unexplained() const {
    return searched_.count(PixelClass::unexplained);
  }

  const Truth& truth_;
  const OtherMap& other_;
  RendererModel model_;
  Attribution found_;     ///< with the given model
  Attribution searched_;  ///< with the model found so far
  std::optional<Hypothesis> put_right_;
  std::optional<std::vector<DepthRelation>> relations_;
};

/// Classifies unexplained pixels that are explained as a convention, named by `finding`.
void Search::name(const Finding& finding, const std::vector<std::uint8_t>& explained) {
  for (std::size_t i = 0; i < found_.classes.size(); ++i) {
    PixelClass& c = found_.classes[i];
    if (c == PixelClass::unexplained && explained[i] != 0) c = PixelClass::convention;
  }
  found_.counts = {};
  for (const PixelClass c : found_.classes) ++found_.counts[static_cast<std::size_t>(c)];
  found_.findings.push_back(finding);
}

void Search::name(const BestTrial& best) {
  put_right_ = best.hypothesis();
  name(best.finding(), best.explained());
}

void Search::name_bias() {
  found_.findings.push_back(
      {"bias",
       fmt::format("window depths are biased by {:+.3g} steps of the storage on average",
                   found_.bias.steps),
       found_.bias.pixels});
}

void Search::name_storage() {
  if (!other_.windows.empty()) return;
  std::optional<CoarseStorage> storage = coarse_storage(truth_.camera, other_, model_);
  const bool is_known = !storage && model_.recorded;
  if (is_known) storage = CoarseStorage{*model_.recorded, "codes"};
  if (!storage) return;
  using Rounding = RecordedDepth::Rounding;
  const bool down = storage->recorded.rounding == Rounding::nearest &&
                    is_rounded_down(truth_, other_, storage->recorded);
  if (is_known && !down) return;
  if (down) storage->recorded.rounding = Rounding::down;
  RendererModel known = model_;
  known.recorded = storage->recorded;
  Attribution next = attribute(truth_, other_, known);
  const std::uint64_t before = unexplained(), left = next.count(PixelClass::unexplained);
  if (left >= before) return;
  model_ = std::move(known);
  searched_ = std::move(next);
  name({"storage",
        fmt::format("depths are stored as {}{}", storage->text, down ? ", rounded down" : ""),
        before - left},
       explained_by(searched_));
  put_right_ = Hypothesis{"storage", found_.findings.back().text, model_, other_};
}

/// Before other faults, since the values themselves show it.
bool Search::by_stored_planes() {
  const std::optional<ClipPlanes> planes = stored_planes(truth_.camera, other_, model_);
  if (!planes) return false;
  Camera camera = truth_.camera;
  camera.near = planes->near;
  camera.far = planes->far;
  BestTrial best(truth_, searched_);
  best.add(
      {.kind = "clip-planes",
       .text = fmt::format("near and far of the map are {:.9g} and {:.9g}, those of the camera "
                           "are {:.9g} and {:.9g}",
                           camera.near, camera.far, truth_.camera.near, truth_.camera.far),
       .model = model_,
       .map = other_,
       .truth = seen_by(truth_, camera),
       .estimates = {{.name = "near", .value = camera.near, .unit = "scene units"},
                     {.name = "far", .value = camera.far, .unit = "scene units"}}});
  if (!best.has_one()) return false;
  name(best);
  return true;
}

bool Search::by_triangles() {
  const std::vector<Finding> findings = triangles_at_fault(truth_, other_, searched_);
  std::uint64_t named = 0;
  for (const Finding& finding : findings) named += finding.pixels;
  if (named == 0 || named * 10 < unexplained() * 9) return false;
  found_.findings.insert(found_.findings.end(), findings.begin(), findings.end());
  return true;
}

bool Search::by_hypotheses() {
  BestTrial best(truth_, searched_);
  for (const MakeHypothesis& make : hypotheses(truth_, other_, model_, searched_)) {
    if (best.is_perfect()) break;
    if (const std::optional<Hypothesis> h = make()) best.add(*h);
  }
  if (!best.has_one()) return false;
  name(best);
  return true;
}

/// Of a map of a pinhole, between its pixels.
bool Search::by_lookup() {
  if (!truth_.lens) return false;
  const auto some = interpolated_lookup(truth_, other_, model_, searched_);
  if (some) name(some->finding, some->explained);
  return some.has_value();
}

/// Computed on first use.
const std::vector<DepthRelation>& Search::relations() {
  if (!relations_) relations_ = depth_relations(truth_, other_);
  return *relations_;
}

bool Search::by_relations(bool excluding_camera) {
  BestTrial best(truth_, searched_);
  for (const DepthRelation& relation : relations()) {
    if (best.has_one()) break;
    if (excluding_camera && !relation.excludes_camera) continue;
    Hypothesis h{relation.kind, relation.text, model_, read_by(relation, other_)};
    h.estimates = relation.estimates;
    h.model.recorded = relation.recorded;
    best.add(h);
  }
  if (!best.has_one()) return false;
  name(best);
  return true;
}

/// Where the codes are coarse, a relation of depths does not hold to their precision. The bounds
/// have to follow from the renderer's planes.
void Search::add_drawn_planes(BestTrial& best) const {
  const auto* const raster = std::get_if<RasterModel>(&model_.kind);
  const bool is_hyperbolic =
      raster != nullptr && !raster->written && raster->mapping != Mapping::log_ulrich;
  if (!is_hyperbolic || model_.recorded || !other_.windows.empty() || best.is_perfect()) return;
  for (const ClipPlanes& planes : drawn_planes(truth_, other_)) {
    if (best.is_perfect()) return;
    Camera camera = truth_.camera;
    camera.near = planes.near;
    camera.far = planes.far;
    best.add({.kind = "decoding",
              .text = fmt::format("depths were decoded with the wrong near and far: the map was "
                                  "drawn with near {:.6g} and far {:.6g}, not {:.6g} and {:.6g}",
                                  planes.near, planes.far, truth_.camera.near, truth_.camera.far),
              .model = model_,
              .map = decoded_again(other_, truth_.camera, planes),
              .truth = seen_by(truth_, camera),
              .estimates = {{.name = "near", .value = planes.near, .unit = "scene units"},
                            {.name = "far", .value = planes.far, .unit = "scene units"}}});
  }
}

/// If a fitted deviation leaves pixels open, the planes of the renderer compete with it.
bool Search::by_deviation() {
  if (truth_.lens) return false;  // the derivatives are those of a pinhole
  BestTrial best(truth_, searched_);
  const std::optional<FittedDeviation> fit = fitted_deviation(truth_, other_, model_, searched_);
  if (fit) best.add(deviation_hypothesis(truth_, other_, model_, *fit));
  add_drawn_planes(best);
  if (!best.has_one()) return false;
  name(best);
  return true;
}

/// The pixels remain unexplained: no bounds follow from an unknown formula.
bool Search::by_curve() {
  const std::optional<std::string> text = text_of_curve(truth_, other_);
  if (text) found_.findings.push_back({"decoding", *text, unexplained()});
  return text.has_value();
}

/// Single wrong pixels remain unexplained: that they are few is not a cause.
bool Search::by_pixels() {
  if (const std::optional<PixelFinding> some = isolated(truth_, other_, searched_)) {
    found_.findings.push_back(some->finding);
    return true;
  }
  for (const auto look : {clipped, lost_lines, mixed}) {
    if (const std::optional<PixelFinding> some = look(truth_, other_, searched_)) {
      name(some->finding, some->explained);
      return true;
    }
  }
  return false;
}

/// Deviations within the roundings of single pixels, which the whole image reveals.
void Search::name_what_is_within_bounds() {
  if (!found_.bias.is_significant()) return;
  const std::optional<FittedDeviation> fit = fitted_deviation(truth_, other_, model_, searched_);
  if (!fit || std::string_view(fit->set->kind) == "bias") {
    name_bias();
    return;
  }
  const Hypothesis h = deviation_hypothesis(truth_, other_, model_, *fit);
  found_.findings.push_back({h.kind, h.text, found_.bias.pixels, h.estimates, h.alternatives});
}

void Search::run() {
  if (unexplained() == 0) {
    name_what_is_within_bounds();
    return;
  }
  name_storage();
  if (unexplained() == 0) return;
  by_stored_planes() || by_triangles() || by_hypotheses() || by_lookup() || by_relations(true) ||
      by_deviation() || by_relations(false) || by_curve() || by_pixels();
}

}  // namespace

Diagnosis diagnose(const Truth& truth, const OtherMap& other, const RendererModel& model,
                   Attribution found) {
  const StandardArithmetic standard;
  Search search(truth, other, model, std::move(found));
  search.run();
  return std::move(search).result();
}

RendererModel as_recorded(const RendererModel& model, const OtherMap& other) {
  RendererModel known = model;
  if (!known.recorded && other.code_scale) {
    known.recorded =
        RecordedDepth{.rounding = RecordedDepth::Rounding::nearest, .step = 1 / *other.code_scale};
  }
  return known;
}

Attribution attribute_and_name(const Truth& truth, const OtherMap& other,
                               const RendererModel& model) {
  const StandardArithmetic standard;
  KnownBackground known = known_background(truth, other);
  const RendererModel known_model = as_recorded(model, other);
  Attribution result =
      diagnose(truth, known.map, known_model, attribute(truth, known.map, known_model)).attribution;
  if (known.note) result.notes.push_back(*known.note);
  return result;
}

}  // namespace fathom::attribution
