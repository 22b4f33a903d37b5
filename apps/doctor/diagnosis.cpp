#include "apps/doctor/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/doctor/noise.h"
#include "apps/doctor/preference.h"
#include "fathom/text/counted.h"
#include "fathom/text/percentage.h"

namespace fathom::doctor {
namespace {

/// Images and pixels of each for the coarse search; pixels of each image for all figures.
constexpr std::size_t coarse_images = 3, coarse_pixels = 3000;
constexpr std::size_t fine_pixels = 60000;
/// With at least this share of explained pixels no coarse fault is looked for.
constexpr double good_share = 0.95;
/// Explained pixels that a coarse fault must add, and what each further fault must add.
constexpr double least_gain = 0.1, gain_of_fault = 0.03;
/// Shares that differ by less do not distinguish two hypotheses.
constexpr double equal_share = 0.01;
/// With less no hypothesis counts as an explanation.
constexpr double poor_share = 0.5;
/// Hypotheses of the coarse search that are compared at all images.
constexpr std::size_t finalists = 16;
/// Factors between units of length.
constexpr std::array unit_factors{1000.0, 0.001, 100.0, 0.01, 10.0, 0.1};
/// Depth scales are rounded to a usual one this near.
constexpr double nearness_of_scale = 0.003;

/// A hypothesis and how well it explains the images.
struct Tried {
  Hypothesis hypothesis;
  Agreement agreement;
  /// Of hypotheses that are compared at all images.
  Noise noise = {};

  [[nodiscard]] std::size_t faults() const { return faults_of(hypothesis).size(); }
  [[nodiscard]] double merit() const { return agreement.share - gain_of_fault * double(faults()); }
  [[nodiscard]] bool explains() const {
    return agreement.share >= poor_share || is_independent(noise);
  }
};

/// Whether two hypotheses ask for the same correction.
bool is_same_correction(const DataSet& data, const Hypothesis& a, const Hypothesis& b) {
  if (a.turn != b.turn || a.is_distance != b.is_distance || a.is_truncated != b.is_truncated ||
      std::abs(a.depth_scale / b.depth_scale - 1) > 1e-3)
    return false;
  return std::ranges::all_of(data.views(), [&](const View& view) {
    const Camera first = corrected(view.camera, a, view.image.size);
    const Camera second = corrected(view.camera, b, view.image.size);
    if (first.projection != second.projection) return false;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (std::abs(first.world_to_camera[i][j] - second.world_to_camera[i][j]) >
            1e-6 * (1 + std::abs(first.world_to_camera[i][j])))
          return false;
    return true;
  });
}

/// The usual scale next to an estimated one.
double usual_scale(double scale) {
  for (const double power :
       {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6})
    for (const double digit : {1.0, 2.0, 2.5, 2.56, 3.048, 2.54, 4.0, 5.0, 6.5535, 6.5536})
      if (std::abs(scale / (digit * power) - 1) < nearness_of_scale) return digit * power;
  return scale;
}

/// All values of one member of a hypothesis, the given one first.
template <class Value, std::size_t count>
std::vector<Value> with_given(Value given, const std::array<Value, count>& others) {
  std::vector<Value> all{given};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

std::vector<LensMeaning> meanings_of(const DataSet& data) {
  std::vector<LensMeaning> meanings{LensMeaning::as_given};
  for (const View& view : data.views()) {
    for (const LensMeaning meaning : other_meanings(view.camera.projection.lens))
      if (std::ranges::find(meanings, meaning) == meanings.end()) meanings.push_back(meaning);
  }
  return meanings;
}

/// Hypotheses that differ in what has to be rendered, of at most `most` faults.
std::vector<Hypothesis> renderings(const DataSet& data, std::size_t most) {
  const std::vector<LensMeaning> meanings = meanings_of(data);
  std::vector<Resizing> resizings{Resizing::as_given};
  if (data.has_other_sizes()) {
    resizings.push_back(Resizing::scaled);
    resizings.push_back(Resizing::cropped);
  }
  std::vector<Hypothesis> all{Hypothesis()};
  const auto multiply = [&](const auto& values, auto member) {
    std::vector<Hypothesis> product;
    for (const Hypothesis& h : all) {
      for (const auto& value : values) {
        Hypothesis with = h;
        with.*member = value;
        if (faults_of(with).size() <= most) product.push_back(with);
      }
    }
    all = std::move(product);
  };
  multiply(resizings, &Hypothesis::resizing);
  multiply(with_given(Matrix::as_given, std::array{Matrix::inverse, Matrix::inverse_of_turned,
                                                   Matrix::inverse_of_opengl}),
           &Hypothesis::matrix);
  multiply(with_given(CameraAxes::as_given, std::array{CameraAxes::opengl, CameraAxes::body}),
           &Hypothesis::camera_axes);
  multiply(with_given(WorldAxes::as_given,
                      std::array{WorldAxes::x_minus_z_y, WorldAxes::x_z_minus_y,
                                 WorldAxes::x_minus_y_minus_z, WorldAxes::y_z_x, WorldAxes::z_x_y}),
           &Hypothesis::world_axes);
  multiply(with_given(1.0, unit_factors), &Hypothesis::unit);
  multiply(meanings, &Hypothesis::lens);
  // The orders of inversion differ only in axes.
  std::erase_if(all, [](const Hypothesis& h) {
    return (h.matrix == Matrix::inverse_of_turned && h.camera_axes == CameraAxes::as_given) ||
           (h.matrix == Matrix::inverse_of_opengl && h.camera_axes == CameraAxes::opengl);
  });
  return all;
}

std::vector<Turn> turns_of(const DataSet& data) {
  if (data.has_turned_sizes()) return {Turn::as_given, Turn::left, Turn::right};
  return {Turn::as_given, Turn::mirrored_x, Turn::mirrored_y, Turn::half};
}

/// The hypotheses of one rendering, with at most `most` faults.
void try_rendering(DataSet& data, const Hypothesis& rendering, std::size_t most,
                   std::vector<Tried>& tried) {
  const std::vector<Grid>& grids = data.grids(rendering, coarse_images, coarse_pixels);
  for (const Turn turn : turns_of(data)) {
    for (const bool is_distance : {false, true}) {
      Hypothesis h = rendering;
      h.turn = turn;
      h.is_distance = is_distance;
      if (faults_of(h).size() > most) continue;
      const std::vector<Pair> pairs = data.pairs(grids, h);
      const auto try_scale = [&](double scale) {
        h.depth_scale = scale;
        if (faults_of(h).size() <= most) tried.push_back({h, agreement(pairs, scale, Tolerance())});
      };
      try_scale(1);
      if (h.unit != 1) try_scale(1 / h.unit);
      const double scale = usual_scale(median_ratio(pairs));
      if (std::abs(scale - 1) > 2 * nearness_of_scale) try_scale(scale);
    }
  }
}

/// The pixels of which all figures are.
std::vector<Pair> pairs_of(DataSet& data, const Hypothesis& h,
                           CeilingPixels of_ceiling = CeilingPixels::left_out) {
  return data.pairs(data.grids(h, data.views().size(), fine_pixels), h, of_ceiling);
}

Tried tried_on_all(DataSet& data, const Hypothesis& h, const Tolerance& tolerance) {
  const std::vector<Pair> pairs = pairs_of(data, h);
  return {h, agreement(pairs, h.depth_scale, tolerance), noise_of(pairs, h.depth_scale)};
}

/// The best hypothesis, and others that explain the images as well by as many faults.
struct Choice {
  Tried best;
  std::vector<Hypothesis> equals = {};
  /// The best of the others, if none explains the images.
  std::optional<Tried> nearest = {};
};

Choice choose_coarse(DataSet& data, const Tried& given,
                     const std::function<void(double)>& progress) {
  const std::size_t most = data.has_other_sizes() ? 3 : 2;
  const std::vector<Hypothesis> all = renderings(data, most);
  std::vector<Tried> tried;
  for (std::size_t i = 0; i < all.size(); ++i) {
    try_rendering(data, all[i], most, tried);
    if (progress) progress(double(i + 1) / double(all.size()));
  }
  std::ranges::stable_sort(tried, std::ranges::greater(), &Tried::merit);
  std::vector<Tried> best;
  for (const Tried& t : tried) {
    if (best.size() == finalists) break;
    const bool is_known = std::ranges::any_of(
        best, [&](const Tried& b) { return is_same_correction(data, b.hypothesis, t.hypothesis); });
    if (!is_known) best.push_back(tried_on_all(data, t.hypothesis, Tolerance()));
  }
  std::ranges::stable_sort(best, std::ranges::greater(), &Tried::merit);
  std::stable_partition(best.begin(), best.end(), [](const Tried& t) { return t.explains(); });
  const bool is_noise = is_independent(best.front().noise) && !is_independent(given.noise);
  const bool is_gain = best.front().agreement.share >= given.agreement.share + least_gain;
  if (!best.front().explains() || (!is_gain && !is_noise)) return {given, {}, best.front()};
  Choice choice{best.front()};
  for (std::size_t i = 1; i < best.size(); ++i) {
    const Tried& other = best[i];
    const Agreement &a = choice.best.agreement, &b = other.agreement;
    // Depths to the last bits, or silhouettes, may still distinguish the two.
    const bool is_equal = other.faults() == choice.best.faults() &&
                          b.share > a.share - equal_share && b.median <= 1.25 * a.median &&
                          std::abs(a.silhouettes - b.silhouettes) < equal_share &&
                          is_independent(other.noise) == is_independent(choice.best.noise);
    const bool is_better =
        other.faults() == choice.best.faults() && b.share > a.share - equal_share &&
        (b.median * 1.25 < a.median && b.silhouettes >= a.silhouettes - equal_share);
    if (is_better) {
      choice = {other};
    } else if (is_equal) {
      choice.equals.push_back(other.hypothesis);
    }
  }
  return choice;
}

/// Small changes of a hypothesis, each one fault more or one less.
std::vector<Hypothesis> small_changes(const DataSet& data, const Hypothesis& h) {
  std::vector<Hypothesis> changes;
  const auto add = [&](auto member, auto value) {
    Hypothesis changed = h;
    changed.*member = value;
    changes.push_back(changed);
  };
  add(&Hypothesis::is_distance, !h.is_distance);
  for (const LensMeaning meaning : meanings_of(data))
    if (meaning != h.lens) add(&Hypothesis::lens, meaning);
  // An image of which every second row and column was taken is off by a quarter of its pixels.
  for (const double step : {0.5, 0.25}) {
    for (const double x : {-step, 0.0, step}) {
      for (const double y : {-step, 0.0, step}) {
        Hypothesis shifted = h;
        shifted.shift_x = x;
        shifted.shift_y = y;
        const bool is_tried_before = step != 0.5 && x == 0 && y == 0;
        if (!is_tried_before && (x != h.shift_x || y != h.shift_y)) changes.push_back(shifted);
      }
    }
  }
  return changes;
}

/// Whether codes are the exact depths rounded towards zero, and not to nearest.
bool is_truncated(const std::vector<Pair>& pairs, double depth_scale) {
  std::uint64_t down = 0, nearest = 0, count = 0;
  for (const Pair& pair : pairs) {
    if (pair.step == 0 || !std::isfinite(pair.stored) || !std::isfinite(pair.exact)) continue;
    const double exact = pair.exact * depth_scale / double(pair.step);
    const double code = std::round(double(pair.stored) / double(pair.step));
    ++count;
    if (code == std::floor(exact)) ++down;
    if (code == std::nearbyint(exact)) ++nearest;
  }
  return count >= 200 && down * 10 >= count * 9 && nearest * 10 <= down * 8;
}

/// The depth scale by which stored depths are wrong everywhere; nothing if there is no such scale.
std::optional<double> small_scale(const std::vector<Pair>& pairs, double depth_scale) {
  const double scale = usual_scale(median_ratio(pairs));
  if (std::abs(scale / depth_scale - 1) < 2 * nearness_of_scale) return std::nullopt;
  const auto certain = preference(pairs, depth_scale, pairs, scale);
  return certain && is_certain(*certain) ? std::optional(scale) : std::nullopt;
}

/// The small fault that is certain and leaves the least residuals.
std::optional<Hypothesis> next_small(DataSet& data, const Hypothesis& h) {
  const std::vector<Pair> now = pairs_of(data, h);
  if (!h.is_truncated && is_truncated(now, h.depth_scale)) {
    Hypothesis truncated = h;
    truncated.is_truncated = true;
    return truncated;
  }
  std::optional<Hypothesis> best;
  double least = 1;
  const auto consider = [&](Hypothesis changed) {
    const std::vector<Pair> pairs = pairs_of(data, changed);
    // A scale that was estimated without the change is wrong by the mean effect of the change.
    if (h.depth_scale != 1 && changed.depth_scale == h.depth_scale)
      changed.depth_scale = usual_scale(median_ratio(pairs));
    const auto found = preference(now, h.depth_scale, pairs, changed.depth_scale);
    if (!found || !is_certain(*found)) return;
    const Tolerance fine{.of_depth = 3 * median_relative(pairs, changed.depth_scale)};
    const double before = agreement(now, h.depth_scale, fine).share;
    const double after = agreement(pairs, changed.depth_scale, fine).share;
    const double measure = (1 - after) / std::max(1 - before, 1e-9);
    if (after <= before || measure >= least) return;
    least = measure;
    best = changed;
  };
  for (const Hypothesis& changed : small_changes(data, h)) consider(changed);
  if (const auto scale = small_scale(now, h.depth_scale)) {
    Hypothesis scaled = h;
    scaled.depth_scale = *scale;
    consider(scaled);
  }
  return best;
}

std::string text_of(const Hypothesis& h) {
  std::string text;
  for (const Fault fault : faults_of(h))
    text += (text.empty() ? "" : "; and ") + name_of(fault) + ": " + text_of(fault, h);
  return text;
}

/// The option that reads codes with the right scale, if a scale is the fault.
std::string scale_of_codes(const DataSet& data, const Hypothesis& h, Fault fault) {
  const std::optional<double> scale = data.views().front().image.code_scale;
  if (fault != Fault::depth_scale || !scale) return {};
  return fmt::format("; --png-scale {:.6g} reads the codes in units of the mesh",
                     *scale * h.depth_scale);
}

/// The tolerance of all figures.
Tolerance tolerance_of(const Diagnosis& found) {
  return {.of_depth = found.tolerance, .of_range = 1};
}

/// What the numbers at the ceiling stand for. If they are no depths, the figures of the data set as
/// given include them, and the corrected figures do not.
void judge_ceiling(DataSet& data, Diagnosis& found) {
  if (!data.ceiling()) return;
  const Hypothesis& h = found.hypothesis;
  const double ceiling = data.ceiling()->depth;
  const std::vector<Pair> pairs = pairs_of(data, h, CeilingPixels::alone);
  std::uint64_t none = 0, beyond = 0, right = 0;
  for (const Pair& pair : pairs) {
    if (!std::isfinite(pair.stored)) continue;
    const double exact = pair.exact * h.depth_scale;
    if (!std::isfinite(pair.exact)) {
      ++none;
    } else if (exact > ceiling + std::max(double(pair.step), found.tolerance * ceiling)) {
      ++beyond;
    } else if (exact > ceiling * 0.98) {
      ++right;
    }
  }
  const std::uint64_t all = none + beyond + right;
  if (all == 0 || 10 * right > 3 * all) return;
  FoundFault fault;
  if (beyond > none) {
    fault.name = "clipped";
    fault.text = fmt::format(
        "depths beyond {:g} are stored as {:g}: {} of {} such pixels that were looked at show a "
        "surface farther away",
        ceiling, ceiling, beyond, all);
  } else {
    fault.name = "no-value";
    fault.text = fmt::format(
        "{:g} stands for no value: {} of {} such pixels that were looked at show no surface",
        ceiling, none, all);
  }
  const auto agreement_of = [&](const Hypothesis& one, CeilingPixels of_ceiling) {
    return agreement(pairs_of(data, one, of_ceiling), one.depth_scale, tolerance_of(found));
  };
  found.given = agreement_of(Hypothesis(), CeilingPixels::as_stored);
  found.corrected = agreement_of(h, CeilingPixels::as_none);
  fault.evidence = {agreement_of(h, CeilingPixels::as_stored), found.corrected};
  found.faults.push_back(std::move(fault));
  found.no_value = ceiling;
}

void note_zeros(const DataSet& data, Diagnosis& found) {
  std::uint64_t zeros = 0;
  bool is_none = true;
  for (const View& view : data.views()) {
    zeros += view.image.zeros;
    is_none = is_none && view.image.is_zero_none;
  }
  if (zeros == 0) return;
  found.notes.push_back(
      fmt::format("0 stands for no value, in {}{}", text::counted(zeros, "pixel"),
                  is_none ? "" : "; other pixels without a value have other numbers"));
}

}  // namespace

std::string name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::well:
      return "well";
    case Verdict::faulty:
      return "faulty";
    case Verdict::unclear:
      return "unclear";
    case Verdict::unknown:
      return "unknown";
  }
  return {};
}

Diagnosis diagnose(DataSet& data, const std::function<void(double)>& progress) {
  Diagnosis found;
  found.images = data.views().size();
  const Tried given = tried_on_all(data, Hypothesis(), Tolerance());
  Choice choice{given};
  // A wrong camera displaces surfaces, so neighbouring pixels deviate alike.
  const bool is_good = given.agreement.share >= good_share || is_independent(given.noise);
  if (!is_good || data.has_other_sizes()) choice = choose_coarse(data, given, progress);
  Hypothesis h = choice.best.hypothesis;
  // A wrong hypothesis has no small faults.
  const bool is_explained = choice.best.explains();
  constexpr int most_small = 4;
  for (int i = 0; i < most_small && is_explained; ++i) {
    const std::optional<Hypothesis> next = next_small(data, h);
    if (!next) break;
    h = *next;
  }
  found.hypothesis = h;
  const std::vector<Pair> final_pairs = pairs_of(data, h);
  // Three medians of absolute residuals are two deviations of a normal distribution.
  constexpr double greatest_tolerance = 0.05;
  found.noise = noise_of(final_pairs, h.depth_scale);
  found.is_noisy =
      is_explained && agreement(final_pairs, h.depth_scale, Tolerance()).share < poor_share;
  found.tolerance = is_explained ? 4.5 * median_relative(final_pairs, h.depth_scale) : 0.02;
  if (!found.is_noisy) found.tolerance = std::min(found.tolerance, greatest_tolerance);
  const Tolerance tolerance = tolerance_of(found);
  found.corrected = agreement(final_pairs, h.depth_scale, tolerance);
  found.given = agreement(pairs_of(data, Hypothesis()), 1, tolerance);
  for (const Fault fault : faults_of(h)) {
    const Hypothesis other = without(h, fault);
    found.faults.push_back(
        {.name = name_of(fault),
         .text = text_of(fault, h) + scale_of_codes(data, h, fault),
         .evidence = {agreement(pairs_of(data, other), other.depth_scale, tolerance),
                      found.corrected}});
  }
  for (const Hypothesis& equal : choice.equals)
    if (!found.faults.empty()) found.faults.front().alternatives.push_back(text_of(equal));
  if (is_explained) judge_ceiling(data, found);
  note_zeros(data, found);
  if (choice.nearest && choice.nearest->faults() > 0 && !is_explained)
    found.notes.push_back(fmt::format("the best attempt explains {} of the pixels: {}",
                                      text::percentage(choice.nearest->agreement.share),
                                      text_of(choice.nearest->hypothesis)));
  found.verdict = !is_explained            ? Verdict::unknown
                  : !choice.equals.empty() ? Verdict::unclear
                  : found.faults.empty()   ? Verdict::well
                                           : Verdict::faulty;
  return found;
}

}  // namespace fathom::doctor
