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
/// How well a constant has to be known to be taken for a round number, relatively.
constexpr double as_good_as_round = 1e-4;

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
         "logarithmic depths were decoded with the wrong near and far: ln(stored) = "
         "{:.6g}·ln(depth) + {:.6g}",
         DepthTerm::logarithm, DepthTerm::logarithm},
    Form{"decoding", "logarithmic depths that were not decoded: stored = {:.6g}·ln(depth) + {:.6g}",
         DepthTerm::depth, DepthTerm::logarithm}};

/// term(depth) and term(stored) of a pixel, and the change of the depth's term by a relative change
/// of the depth.
struct Pair {
  double x, y, slope, depth;
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
    pairs.push_back({term_of(form.depth, depth), y, slope_of(form.depth, depth), depth});
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

/// Rounds a factor that is nearly 1, 10, 100, … of a unit, or its inverse or negative, to this
/// value.
double rounded_factor(double alpha) {
  for (const double round : {1.0, 10.0, 100.0, 1000.0, 10000.0, 1e6, 0.0254, 0.3048, 0.9144, 255.0,
                             256.0, 5000.0, 65535.0, 65536.0}) {
    for (const double r : {round, 1 / round, -round}) {
      if (std::abs(alpha / r - 1) < as_good_as_round) return r;
    }
  }
  return alpha;
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

/// Whether binary32 stores one value for all pairs, though their depths differ.
bool is_constant(const std::vector<Pair>& pairs) {
  const Pair& first = pairs.front();
  const double resolved = unit_roundoff<float> * std::abs(first.y);
  return std::ranges::all_of(pairs,
                             [&](const Pair& p) { return std::abs(p.y - first.y) <= resolved; }) &&
         std::ranges::any_of(pairs, [&](const Pair& p) { return p.x != first.x; });
}

/// Codes that cover all recorded values: whole numbers, or multiples of 1/255, 1/1023, 1/4095 or
/// 1/65535; codes are at least 16 times as far apart as binary32 resolves. A constant is no code.
void set_codes(RecordedDepth& recorded, const std::vector<Pair>& pairs) {
  if (is_constant(pairs)) return;
  for (const double step : {1.0, 1.0 / 255, 1.0 / 1023, 1.0 / 4095, 1.0 / 65535}) {
    const bool all = std::all_of(pairs.begin(), pairs.end(), [&](const Pair& p) {
      const double resolved = 4 * unit_roundoff<float> * std::abs(p.y);
      return 16 * resolved <= step && std::abs(p.y - step * std::nearbyint(p.y / step)) <= resolved;
    });
    if (!all) continue;
    recorded.rounding = RecordedDepth::Rounding::nearest;
    recorded.step = step;
    return;
  }
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

/// Whether a line equals the estimated line up to codes or roundings.
bool is_as_good(const std::vector<Pair>& pairs, const Line& line, const Line& fitted, double step) {
  const double typical = pairs[pairs.size() / 2].slope;
  return median_residual(pairs, line) <=
         std::max(1.5 * median_residual(pairs, fitted), step / 2 / typical);
}

/// Below this share of another term, a term is lost when binary32 stores the sum.
constexpr double lost_share = unit_roundoff<float>;

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
    if (greatest <= lost_share * std::abs(line.beta)) {
      return fmt::format(
          "the channel hardly depends on depth: it is {:.6g} nearly everywhere; "
          "expected the channel of depths",
          form.stored == DepthTerm::inverse     ? 1 / line.beta
          : form.stored == DepthTerm::logarithm ? std::exp(line.beta)
                                                : line.beta);
    }
    if (std::abs(line.beta) <= lost_share * least) {
      pattern.erase(sum);
    } else if (line.beta < 0) {
      pattern[sum + 1] = '-';
    }
  }
  return fmt::format(fmt::runtime(pattern), line.alpha, std::abs(line.beta));
}

std::optional<DepthRelation> related(const Truth& truth, const OtherMap& other, const Form& form) {
  const std::vector<Pair> pairs = pairs_of(truth, other, form);
  std::optional<Line> line = robust_fit(pairs, form);
  if (!line || line->alpha == 0) return std::nullopt;
  DepthRelation relation{.kind = form.kind, .stored = form.stored};
  relation.parameters = static_cast<int>(form.free_factor) + static_cast<int>(form.free_offset);
  set_codes(relation.recorded, pairs);
  if (form.free_factor && !form.free_offset) line->alpha = rounded_factor(line->alpha);
  for (const Line& known : known_lines(form, truth.camera)) {
    if (relation.parameters == 0 || !is_as_good(pairs, known, *line, relation.recorded.step)) {
      continue;
    }
    line = known;
    relation.parameters = 0;
  }
  relation.recorded.term = form.depth;
  relation.recorded.factor = line->alpha;
  relation.recorded.offset = line->beta;
  relation.is_gross = !(std::abs(line->alpha - 1) < 0.01) || form.depth != form.stored;
  const double error = relation.recorded.step;
  for (const Pair& p : pairs) {
    const bool agrees =
        line->residual(p) * p.slope <= agreement * std::abs(line->alpha) * p.slope + error;
    relation.pixels += agrees ? 1 : 0;
  }
  if (static_cast<double>(relation.pixels) < agreeing_share * static_cast<double>(pairs.size())) {
    return std::nullopt;
  }
  relation.text = text_of(form, *line, pairs) + meaning_of(form, *line, truth.camera);
  if (relation.recorded.step > 0) {
    relation.text += relation.recorded.step == 1
                         ? ", in whole numbers"
                         : fmt::format(", in codes of 1/{:.0f}", 1 / relation.recorded.step);
  }
  return relation;
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
    if (auto relation = related(truth, other, form)) found.push_back(std::move(*relation));
  }
  std::stable_sort(found.begin(), found.end(), [](const DepthRelation& a, const DepthRelation& b) {
    return a.parameters < b.parameters;
  });
  return found;
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
