#include "fathom/attribution/faults/depth_relation.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/attribution/robust_statistics.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pixels on which an estimate has to rest.
constexpr std::size_t least_pixels = 16;
/// Where a depth agrees, relatively, and the share of the pixels that has to.
constexpr double agreement = 1e-4, agreeing_share = 0.8;
/// How near a factor has to be to a round number, relatively, to be tried as this number.
constexpr double near_round = 1e-3;
/// Different depths on which two estimated constants have to rest, and the shape of a curve.
constexpr std::size_t least_distinct = 8, least_distinct_of_curve = 16;

/// term(stored) = alpha·term(depth) + beta; `free` are the estimated constants, the others are 1
/// and 0.
struct Form {
  const char *kind, *text;
  DepthTerm stored, depth;
  bool free_factor = true, free_offset = true;
};
constexpr std::array forms{
    Form{"scale", "depths are scaled: stored = {:.6g}·depth", DepthTerm::depth, DepthTerm::depth,
         true, false},
    Form{"scale", "depths are offset: stored = depth + {1:.6g}", DepthTerm::depth, DepthTerm::depth,
         false, true},
    Form{"scale", "depths are scaled and offset: stored = {:.6g}·depth + {:.6g}", DepthTerm::depth,
         DepthTerm::depth},
    Form{"decoding",
         "depths were decoded with the wrong near and far: 1/stored = {:.6g}/depth + {:.6g}",
         DepthTerm::inverse, DepthTerm::inverse},
    Form{"decoding", "disparities in place of depths: stored = {:.6g}/depth", DepthTerm::depth,
         DepthTerm::inverse, true, false},
    Form{"decoding",
         "window depths (or disparities) that were not decoded: stored = {:.6g}/depth + {:.6g}",
         DepthTerm::depth, DepthTerm::inverse},
    Form{
        "decoding",
        "window depths decoded by the wrong projection's formula: 1/stored = {:.6g}·depth + {:.6g}",
        DepthTerm::inverse, DepthTerm::depth},
    Form{"decoding",
         "a power of the depth (a gamma, or logarithmic depths decoded with the wrong near and "
         "far): ln(stored) = {:.6g}·ln(depth) + {:.6g}",
         DepthTerm::logarithm, DepthTerm::logarithm},
    Form{"decoding", "logarithmic depths that were not decoded: stored = {:.6g}·ln(depth) + {:.6g}",
         DepthTerm::depth, DepthTerm::logarithm}};

/// term(depth) and term(stored) of a pixel, and the change of the depth's term by a relative change
/// of the depth.
struct Pair {
  double x, y, slope;
};

double slope_of(DepthTerm term, double depth) {
  return term == DepthTerm::depth ? depth : term == DepthTerm::inverse ? 1 / depth : 1;
}

std::vector<Pair> pairs_of(const Truth& truth, const OtherMap& other, const Form& form) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    const double depth = truth.depths[i], stored = other.depths[i];
    if (!(std::abs(depth) < infinity) || !(std::abs(stored) < infinity)) continue;
    const bool needs_positive = form.stored == DepthTerm::logarithm;
    if (form.stored != DepthTerm::depth && (stored == 0 || (needs_positive && stored < 0)))
      continue;
    const double y = form.stored == DepthTerm::inverse ? 1 / stored : term_of(form.stored, stored);
    pairs.push_back({term_of(form.depth, depth), y, slope_of(form.depth, depth)});
  }
  return pairs;
}

struct Line {
  double alpha = 1, beta = 0;

  [[nodiscard]] double residual(const Pair& p) const {
    return std::abs(p.y - alpha * p.x - beta) / p.slope;
  }
};

double median_residual(const std::vector<Pair>& pairs, const Line& line) {
  std::vector<double> residuals;
  residuals.reserve(pairs.size());
  for (const Pair& p : pairs) residuals.push_back(line.residual(p));
  return median_of(residuals);
}

/// The line of least squares of relative errors, without the pairs beyond `limit`.
std::optional<Line> fitted(const std::vector<Pair>& pairs, const Form& form, const Line& before,
                           double limit) {
  const auto rows = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd terms(rows,
                        static_cast<int>(form.free_factor) + static_cast<int>(form.free_offset));
  Eigen::VectorXd y(rows);
  Eigen::Index n = 0;
  for (const Pair& p : pairs) {
    if (before.residual(p) > limit) continue;
    int k = 0;
    if (form.free_factor) terms(n, k++) = p.x / p.slope;
    if (form.free_offset) terms(n, k++) = 1 / p.slope;
    y[n++] = (form.free_factor ? p.y : p.y - p.x) / p.slope;
  }
  if (n < static_cast<Eigen::Index>(least_pixels)) return std::nullopt;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposed(terms.topRows(n));
  if (decomposed.rank() < terms.cols()) return std::nullopt;
  const Eigen::VectorXd found = decomposed.solve(y.head(n));
  Line line;
  int k = 0;
  if (form.free_factor) line.alpha = found[k++];
  if (form.free_offset) line.beta = found[k++];
  return line;
}

/// Each fit after the first leaves out pixels whose residual exceeds 3, later 10 times the median.
std::optional<Line> robust_fit(const std::vector<Pair>& pairs, const Form& form) {
  if (pairs.size() < least_pixels) return std::nullopt;
  Line line;
  double limit = infinity;
  for (int round = 0; round < 6; ++round) {
    const std::optional<Line> next = fitted(pairs, form, line, limit);
    if (!next) return std::nullopt;
    line = *next;
    limit = (round == 0 ? 3 : 10) * median_residual(pairs, line);
  }
  return line;
}

/// Numbers of codes in a unit, or of units in another unit.
constexpr std::array usual_factors{1.0,    10.0,   100.0,  1000.0,  10000.0, 1e6,    0.0254,
                                   0.3048, 0.9144, 255.0,  256.0,   512.0,   1024.0, 4000.0,
                                   4096.0, 5000.0, 6553.5, 65535.0, 65536.0};

/// Usual factors and their inverses, and numbers of two digits, that are nearly a positive value.
std::vector<double> round_numbers_near(double value) {
  std::vector<double> numbers;
  const auto add = [&](double number) {
    if (std::abs(value / number - 1) < near_round) numbers.push_back(number);
  };
  for (const double factor : usual_factors) {
    add(factor);
    add(1 / factor);
  }
  add(rounded_to_digits(value, 2));
  return numbers;
}

/// The constants as functions of near and far, if these explain them.
std::string meaning_of(const Form& form, const Line& line, const Camera& c) {
  const auto is = [&](double alpha, double beta) {
    return std::abs(line.alpha - alpha) <= 1e-3 * std::abs(alpha) &&
           std::abs(line.beta - beta) <= 1e-3 * std::max(std::abs(alpha), std::abs(beta));
  };
  if (form.stored == DepthTerm::depth && form.depth == DepthTerm::depth) {
    if (is(1000, 0)) return " (millimetres for metres)";
    if (is(100, 0)) return " (centimetres for metres)";
    if (is(0.001, 0)) return " (metres for millimetres)";
    if (is(-1, 0)) return " (the camera's z axis points backwards)";
  }
  if (!(c.far < infinity)) return "";
  if (is(1 / c.far, 0)) return " (as parts of far)";
  if (is(1 / (c.far - c.near), -c.near / (c.far - c.near))) {
    return " (0 at near and 1 at far, not decoded)";
  }
  const double range = c.far - c.near, a = c.far / range, b = -c.far * c.near / range;
  if (form.stored == DepthTerm::depth && form.depth == DepthTerm::inverse) {
    if (is(b, a)) return " (0 at near and 1 at far)";
    if (is(2 * b, 2 * a - 1)) return " (z of −1 at near and 1 at far)";
    if (is(-b, 1 - a)) return " (reversed: 1 at near and 0 at far)";
  }
  if (form.stored == DepthTerm::inverse && form.depth == DepthTerm::inverse && c.near > 0) {
    return " (" +
           text_of_decoder(
               c, {1 / (line.beta + line.alpha / c.near), 1 / (line.beta + line.alpha / c.far)}) +
           ")";
  }
  return "";
}

/// Whether binary32 stores `value` and the sum of both alike.
bool is_lost(double change, double value) {
  return std::abs(change) <= unit_roundoff<float> * std::abs(value);
}

/// Whether binary32 stores one value for all pairs, though their depths differ.
bool is_constant(const std::vector<Pair>& pairs) {
  const Pair& first = pairs.front();
  return std::ranges::all_of(pairs,
                             [&](const Pair& p) { return is_lost(p.y - first.y, first.y); }) &&
         std::ranges::any_of(pairs, [&](const Pair& p) { return p.x != first.x; });
}

std::vector<double> distinct(const std::vector<Pair>& pairs, double Pair::*member) {
  std::vector<double> values;
  values.reserve(pairs.size());
  for (const Pair& p : pairs) values.push_back(p.*member);
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values);
  values.erase(repeated.begin(), repeated.end());
  return values;
}

/// The step of codes that cover all recorded values: whole numbers, multiples of 1/255, 1/1023,
/// 1/4095 or 1/65535, another common step, or the codes of a map of integers. Codes are at least 16
/// times as far apart as binary32 resolves. A constant is no code. 0: there are no codes.
double step_of_codes(const OtherMap& other, const std::vector<Pair>& pairs) {
  if (is_constant(pairs)) return 0;
  for (const double step : {1.0, 1.0 / 255, 1.0 / 1023, 1.0 / 4095, 1.0 / 65535}) {
    const bool all = std::all_of(pairs.begin(), pairs.end(), [&](const Pair& p) {
      const double resolved = 4 * unit_roundoff<float> * std::abs(p.y);
      return 16 * resolved <= step && std::abs(p.y - step * std::nearbyint(p.y / step)) <= resolved;
    });
    if (all) return step;
  }
  if (other.code_scale) return 1 / *other.code_scale;
  return common_step(distinct(pairs, &Pair::y)).value_or(0);
}

/// Lines that near and far make, of a form.
std::vector<Line> known_lines(const Form& form, const Camera& c) {
  const bool are_two = form.free_factor && form.free_offset;
  if (form.stored != DepthTerm::depth || !are_two || !(c.far < infinity)) return {};
  const double range = c.far - c.near;
  if (form.depth == DepthTerm::depth) return {{1 / range, -c.near / range}};
  if (form.depth == DepthTerm::logarithm && c.near > 0) {
    const double scale = 1 / std::log(c.far / c.near);
    return {{scale, -scale * std::log(c.near)}};
  }
  const double a = c.far / range, b = -c.far * c.near / range;
  return {{b, a}, {2 * b, 2 * a - 1}, {-b, 1 - a}, {-2 * b, 1 - 2 * a}};
}

/// Relative errors of depths that are roundings of the fit, far below those of binary32.
constexpr double own_residual = 1e-10;

/// Whether a line equals the estimated line up to codes or roundings.
bool is_as_good(const std::vector<Pair>& pairs, const Line& line, const Line& fitted, double step) {
  const double typical = pairs[pairs.size() / 2].slope;
  return median_residual(pairs, line) <=
         std::max({1.5 * median_residual(pairs, fitted), step / 2 / typical,
                   own_residual * std::abs(fitted.alpha)});
}

/// The line in words; a term that is lost beside the other is left out.
std::string text_of(const Form& form, const Line& line, const std::vector<Pair>& pairs) {
  double least = infinity, greatest = 0;
  for (const Pair& p : pairs) {
    least = std::min(least, std::abs(line.alpha * p.x));
    greatest = std::max(greatest, std::abs(line.alpha * p.x));
  }
  std::string pattern = form.text;
  const std::size_t sum = pattern.find(" + {");
  if (sum != std::string::npos) {
    if (is_lost(greatest, line.beta)) {
      return fmt::format(
          "the channel hardly depends on depth: it is {:.6g} nearly everywhere; "
          "expected the channel of depths",
          form.stored == DepthTerm::inverse     ? 1 / line.beta
          : form.stored == DepthTerm::logarithm ? std::exp(line.beta)
                                                : line.beta);
    }
    if (is_lost(line.beta, least)) {
      pattern.erase(sum);
    } else if (line.beta < 0) {
      pattern[sum + 1] = '-';
    }
  }
  return fmt::format(fmt::runtime(pattern), line.alpha, std::abs(line.beta));
}

/// The rounding to codes as a clause. Of scaled depths of a map of integers, the scale that is
/// right; empty without codes.
std::string text_of_codes(const OtherMap& other, const Form& form, const RecordedDepth& recorded) {
  if (recorded.step == 0) return "";
  const std::string down =
      recorded.rounding == RecordedDepth::Rounding::down ? ", rounded down" : "";
  const bool is_scale = form.depth == DepthTerm::depth && !form.free_offset && recorded.factor > 0;
  if (is_scale && other.code_scale) {
    const double scale = recorded.factor * *other.code_scale;
    return fmt::format("{}: a unit has {:.6g} codes, not {:.6g}; --png-scale {:.6g} reads them",
                       down, scale, *other.code_scale, scale);
  }
  if (recorded.step == 1) return ", in whole numbers" + down;
  const double per_unit = std::nearbyint(1 / recorded.step);
  const bool is_part = std::abs(per_unit * recorded.step - 1) < 1e-6;
  return (is_part ? fmt::format(", in codes of 1/{:.0f}", per_unit)
                  : fmt::format(", in steps of {:.6g}", recorded.step)) +
         down;
}

/// The factor and the offset of depths. Their standard deviations are the typical residual over the
/// root of the number of pixels.
std::vector<Estimate> estimates_of(const Form& form, const Line& line,
                                   const std::vector<Pair>& pairs) {
  if (form.stored != DepthTerm::depth || form.depth != DepthTerm::depth) return {};
  const double deviation =
      median_residual(pairs, line) / std::sqrt(static_cast<double>(pairs.size()));
  std::vector<Estimate> estimates;
  if (form.free_factor) estimates.push_back({"factor", line.alpha, deviation, ""});
  if (form.free_offset) {
    const double typical = pairs[pairs.size() / 2].slope;
    estimates.push_back({"offset", line.beta, deviation * typical, "scene units"});
  }
  return estimates;
}

/// The round factor that fits as well as the line, if there is one: of depths, or of the codes in a
/// unit.
Line with_round_factor(const OtherMap& other, const std::vector<Pair>& pairs, const Line& line,
                       double step) {
  const double sign = line.alpha < 0 ? -1 : 1, factor = std::abs(line.alpha);
  std::vector<double> factors = round_numbers_near(factor);
  if (other.code_scale) {
    for (const double codes : round_numbers_near(factor * *other.code_scale))
      factors.push_back(codes / *other.code_scale);
  }
  for (const double round : factors) {
    const Line rounded{sign * round, line.beta};
    if (is_as_good(pairs, rounded, line, step)) return rounded;
  }
  return line;
}

/// Whether the relation holds at most pixels; counts them.
bool holds(DepthRelation& relation, const Line& line, const std::vector<Pair>& pairs) {
  for (const Pair& p : pairs) {
    const bool agrees = line.residual(p) * p.slope <=
                        agreement * std::abs(line.alpha) * p.slope + relation.recorded.step;
    relation.pixels += agrees ? 1 : 0;
  }
  return static_cast<double>(relation.pixels) >= agreeing_share * static_cast<double>(pairs.size());
}

/// Whether there are enough pixels and depths for the constants of the form.
bool are_enough(const std::vector<Pair>& pairs, const Form& form) {
  if (pairs.size() < least_pixels) return false;
  const bool are_two = form.free_factor && form.free_offset;
  return !are_two || distinct(pairs, &Pair::x).size() >= least_distinct;
}

/// The relation of recorded values that are rounded to codes of `step`, or not rounded if it is 0.
/// `line` is estimated from the pairs.
std::optional<DepthRelation> related(const Truth& truth, const OtherMap& other, const Form& form,
                                     const std::vector<Pair>& pairs, Line line, double step,
                                     RecordedDepth::Rounding rounding) {
  if (line.alpha == 0) return std::nullopt;
  DepthRelation relation{.kind = form.kind, .stored = form.stored};
  relation.parameters = static_cast<int>(form.free_factor) + static_cast<int>(form.free_offset);
  relation.recorded.rounding = rounding;
  relation.recorded.step = step;
  if (form.free_factor && !form.free_offset) line = with_round_factor(other, pairs, line, step);
  for (const Line& known : known_lines(form, truth.camera)) {
    if (relation.parameters == 0 || !is_as_good(pairs, known, line, step)) continue;
    line = known;
    relation.parameters = 0;
  }
  relation.recorded.term = form.depth;
  relation.recorded.factor = line.alpha;
  relation.recorded.offset = line.beta;
  const bool is_gross = !(std::abs(line.alpha - 1) < 0.01) || form.depth != form.stored;
  relation.excludes_camera = is_gross && relation.parameters <= 1;
  if (!holds(relation, line, pairs)) return std::nullopt;
  relation.estimates = estimates_of(form, line, pairs);
  relation.text = text_of(form, line, pairs) + meaning_of(form, line, truth.camera) +
                  text_of_codes(other, form, relation.recorded);
  return relation;
}

/// Whether the factor of depths is a usual number, or makes a usual number of codes of a unit.
bool has_round_factor(const DepthRelation& relation, const OtherMap& other) {
  const auto is_round = [](double value) {
    return std::ranges::any_of(round_numbers_near(value), [&](double number) {
      return std::abs(value / number - 1) < own_residual;
    });
  };
  const double factor = std::abs(relation.recorded.factor);
  return is_round(factor) || (other.code_scale && is_round(factor * *other.code_scale));
}

/// The pairs with the middle of the values that are rounded down to a code.
std::vector<Pair> with_middles_of_codes(std::vector<Pair> pairs, double step) {
  for (Pair& p : pairs) p.y += step / 2;
  return pairs;
}

/// The relation of scaled depths that are rounded down to codes, if it is better than the relation
/// `nearest` of codes that are rounded to nearest. A factor fits both roundings, but only the right
/// rounding has a round factor, or the lesser residuals if both factors are round.
std::optional<DepthRelation> rounded_down(const Truth& truth, const OtherMap& other,
                                          const Form& form, const std::vector<Pair>& pairs,
                                          const std::optional<DepthRelation>& nearest,
                                          double step) {
  const std::vector<Pair> middles = with_middles_of_codes(pairs, step);
  const std::optional<Line> line = robust_fit(middles, form);
  if (!line) return std::nullopt;
  auto down = related(truth, other, form, middles, *line, step, RecordedDepth::Rounding::down);
  if (!down || !nearest) return down;
  if (!has_round_factor(*down, other)) return std::nullopt;
  if (!has_round_factor(*nearest, other)) return down;
  const auto residual = [](const std::vector<Pair>& values, const DepthRelation& relation) {
    return median_residual(values, {relation.recorded.factor, relation.recorded.offset});
  };
  return residual(middles, *down) < residual(pairs, *nearest) ? down : std::nullopt;
}

/// The relation of a form. Codes of scaled depths may be rounded down.
std::optional<DepthRelation> relation_of(const Truth& truth, const OtherMap& other,
                                         const Form& form) {
  using Rounding = RecordedDepth::Rounding;
  const std::vector<Pair> pairs = pairs_of(truth, other, form);
  if (!are_enough(pairs, form)) return std::nullopt;
  const std::optional<Line> line = robust_fit(pairs, form);
  if (!line || (form.stored == form.depth && is_as_good(pairs, {}, *line, 0))) return std::nullopt;
  const double step = step_of_codes(other, pairs);
  auto nearest = related(truth, other, form, pairs, *line, step,
                         step == 0 ? Rounding::binary32 : Rounding::nearest);
  const bool is_scale =
      form.stored == DepthTerm::depth && form.depth == DepthTerm::depth && !form.free_offset;
  if (step == 0 || !is_scale) return nearest;
  auto down = rounded_down(truth, other, form, pairs, nearest, step);
  return down ? down : nearest;
}

/// Some of the pairs, evenly.
std::vector<Pair> sample_of(const std::vector<Pair>& pairs, std::size_t most) {
  const std::size_t stride = (pairs.size() + most - 1) / most;
  std::vector<Pair> sample;
  for (std::size_t i = 0; i < pairs.size(); i += stride) sample.push_back(pairs[i]);
  return sample;
}

/// The length of the longest subsequence that does not fall.
std::size_t longest_rise(const std::vector<double>& values) {
  std::vector<double> last;  // the least last value of a subsequence of each length
  for (const double value : values) {
    const auto place = std::ranges::upper_bound(last, value);
    place == last.end() ? last.push_back(value) : void(*place = value);
  }
  return last.size();
}

/// 1/near and 1/far where window depths of 0 and 1 lie.
struct InversePlanes {
  double near = 0, far = 0;

  explicit InversePlanes(const ClipPlanes& planes) : near(1 / planes.near), far(1 / planes.far) {}
  [[nodiscard]] double at(double window) const { return near + window * (far - near); }
  [[nodiscard]] double window(double inverse) const { return (inverse - near) / (far - near); }
};

bool are_planes(const ClipPlanes& planes) {
  return planes.near > 0 && planes.near < planes.far && planes.far < infinity;
}

ClipPlanes planes_of(const Camera& camera) {
  return {camera.near, camera.far};
}

/// The planes of the renderer if the decoder had the camera's. A decoder with `decoder` for the
/// camera's planes makes the same map.
ClipPlanes drawn_for(const Camera& camera, const ClipPlanes& decoder) {
  const InversePlanes own(planes_of(camera)), read(decoder);
  return {1 / own.at(read.window(own.near)), 1 / own.at(read.window(own.far))};
}

}  // namespace

std::string text_of_decoder(const Camera& camera, const ClipPlanes& decoder) {
  const auto text = [](const char* verb, const ClipPlanes& p) {
    return fmt::format("{} with near {:.6g} and far {:.6g}", verb, p.near, p.far);
  };
  const ClipPlanes own = planes_of(camera), drawn = drawn_for(camera, decoder);
  std::string as_decoded = text("decoded", decoder) + " if " + text("drawn", own);
  const std::string as_drawn = text("drawn", drawn) + " if " + text("decoded", own);
  if (!are_planes(drawn)) return as_decoded;
  return are_planes(decoder) ? as_decoded + ", or " + as_drawn : as_drawn;
}

std::vector<ClipPlanes> drawn_planes(const Truth& truth, const OtherMap& other) {
  if (!is_perspective(truth.camera.projection) || !are_planes(planes_of(truth.camera))) return {};
  const auto form = std::find_if(forms.begin(), forms.end(), [](const Form& f) {
    return f.stored == DepthTerm::inverse && f.depth == DepthTerm::inverse;
  });
  const std::vector<Pair> pairs = pairs_of(truth, other, *form);
  const std::optional<Line> line = robust_fit(pairs, *form);
  if (!line) return {};
  const auto depth_of_stored = [&](double stored) {
    return line->alpha / (1 / stored - line->beta);
  };
  const ClipPlanes fitted{depth_of_stored(truth.camera.near), depth_of_stored(truth.camera.far)};
  if (!(fitted.near > 0)) return {};
  std::vector<ClipPlanes> planes;
  const double near = rounded_to_digits(fitted.near, 3);
  if (fitted.far > 0) {
    planes.push_back({near, rounded_to_digits(fitted.far, 1)});
    planes.push_back({near, rounded_to_digits(fitted.far, 2)});
  }
  planes.push_back({near, truth.camera.far});
  planes.push_back(fitted);
  std::erase_if(planes, [](const ClipPlanes& p) { return !are_planes(p); });
  return planes;
}

OtherMap decoded_again(const OtherMap& other, const Camera& camera, const ClipPlanes& planes) {
  const InversePlanes before(planes_of(camera)), after(planes);
  OtherMap read = other;
  for (double& depth : read.depths) {
    if (std::abs(depth) < infinity) depth = 1 / after.at(before.window(1 / depth));
  }
  return read;
}

std::vector<DepthRelation> depth_relations(const Truth& truth, const OtherMap& other) {
  std::vector<DepthRelation> found;
  for (const Form& form : forms) {
    if (auto relation = relation_of(truth, other, form)) found.push_back(std::move(*relation));
  }
  std::stable_sort(found.begin(), found.end(), [](const DepthRelation& a, const DepthRelation& b) {
    return a.parameters < b.parameters;
  });
  return found;
}

std::optional<std::string> text_of_curve(const Truth& truth, const OtherMap& other) {
  constexpr std::size_t most = 2000;
  constexpr double least_off = 0.02, ordered_share = 0.95, same_outline = 0.8;
  std::vector<Pair> pairs = pairs_of(truth, other, forms.front());
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    surfaces += std::isfinite(truth.depths[i]) || std::isfinite(other.depths[i]) ? 1 : 0;
  }
  const bool are_few = distinct(pairs, &Pair::x).size() < least_distinct_of_curve ||
                       distinct(pairs, &Pair::y).size() < least_distinct_of_curve;
  if (are_few || static_cast<double>(pairs.size()) < same_outline * static_cast<double>(surfaces))
    return std::nullopt;
  std::vector<double> off;
  for (const Pair& p : pairs) off.push_back(std::abs(p.y - p.x) / std::abs(p.x));
  if (!(median_of(off) >= least_off)) return std::nullopt;
  pairs = sample_of(pairs, most);
  std::ranges::sort(pairs, {}, &Pair::x);
  std::vector<double> rising, falling;
  for (const Pair& p : pairs) {
    rising.push_back(p.y);
    falling.push_back(-p.y);
  }
  const double least = ordered_share * static_cast<double>(pairs.size());
  const bool rises = static_cast<double>(longest_rise(rising)) >= least;
  if (!rises && static_cast<double>(longest_rise(falling)) < least) return std::nullopt;
  const auto at = [&](double share) {
    return pairs[static_cast<std::size_t>(share * static_cast<double>(pairs.size() - 1))];
  };
  const Pair near = at(0.05), middle = at(0.5), far = at(0.95);
  return fmt::format(
      "the map stores a function of the depth, which {}, and no model explains it: {:.6g} at depth "
      "{:.6g}, {:.6g} at {:.6g}, {:.6g} at {:.6g}; expected depths",
      rises ? "rises with it" : "falls with it", near.y, near.x, middle.y, middle.x, far.y, far.x);
}

OtherMap read_by(const DepthRelation& relation, const OtherMap& other) {
  OtherMap read = other;
  read.windows.clear();
  for (double& depth : read.depths) {
    if (!(std::abs(depth) < infinity)) continue;
    const double recorded =
        relation.stored == DepthTerm::inverse ? 1 / depth : term_of(relation.stored, depth);
    depth = relation.recorded.to_depth(recorded);
  }
  return read;
}

}  // namespace fathom::attribution
