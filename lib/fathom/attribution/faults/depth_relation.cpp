#include "fathom/attribution/faults/depth_relation.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pixels on which an estimate has to rest.
constexpr Eigen::Index least_pixels = 16;
/// Where a depth agrees, relatively, and the share of the pixels that has to.
constexpr double agreement = 1e-4, agreeing_share = 0.95;

/// A number, as it is or made anew.
enum class As { itself, inverse, logarithm };

double as(As kind, double x) {
  return kind == As::itself ? x : kind == As::inverse ? 1 / x : std::log(x);
}
double from(As kind, double x) {
  return kind == As::logarithm ? std::exp(x) : as(kind, x);
}

/// A relation between what is stored and the depth: y(stored) = alpha·x(depth) + beta.
struct Relation {
  const char *kind, *text;
  As stored, depth;
};
constexpr Relation relations[] = {
    {"scale", "depths are scaled and offset: stored = {:.6g}·depth + {:.6g}", As::itself,
     As::itself},
    {"decoding",
     "depths were decoded with the wrong near and far: 1/stored = {:.6g}/depth + {:.6g}",
     As::inverse, As::inverse},
    {"decoding",
     "window depths (or disparities) that were not decoded: stored = {:.6g}/depth + {:.6g}",
     As::itself, As::inverse},
    {"decoding",
     "window depths decoded by the wrong projection's formula: 1/stored = {:.6g}·depth + {:.6g}",
     As::inverse, As::itself},
    {"decoding",
     "logarithmic depths were decoded with the wrong near and far: ln(stored) = {:.6g}·ln(depth) + "
     "{:.6g}",
     As::logarithm, As::logarithm},
    {"decoding", "logarithmic depths that were not decoded: stored = {:.6g}·ln(depth) + {:.6g}",
     As::itself, As::logarithm},
};

/// x(depth) and y(stored) of a pixel.
struct Pair {
  double x, y, depth;
};

std::vector<Pair> pairs_of(const Truth& truth, const OtherMap& other, const Relation& relation) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    const double depth = truth.depths[i], stored = other.depths[i];
    if (!(depth < infinity) || !(stored < infinity) || stored == 0) continue;
    if (relation.stored == As::logarithm && !(stored > 0)) continue;
    pairs.push_back({as(relation.depth, depth), as(relation.stored, stored), depth});
  }
  return pairs;
}

/// y = alpha·x + beta.
struct Line {
  double alpha = 1, beta = 0;

  [[nodiscard]] double residual(const Pair& p) const { return std::abs(p.y - alpha * p.x - beta); }
};

/// The line of least squares through the pairs that lie within `limit` of `before`.
std::optional<Line> fitted(const std::vector<Pair>& pairs, const Line& before, double limit) {
  Eigen::MatrixX2d terms(static_cast<Eigen::Index>(pairs.size()), 2);  // x, 1
  Eigen::VectorXd y(terms.rows());
  Eigen::Index n = 0;
  for (const Pair& p : pairs) {
    if (before.residual(p) > limit) continue;
    terms.row(n) << p.x, 1;
    y[n] = p.y;
    ++n;
  }
  if (n < least_pixels) return std::nullopt;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX2d> decomposed(terms.topRows(n));
  if (decomposed.rank() < 2) return std::nullopt;
  const Eigen::Vector2d line = decomposed.solve(y.head(n));
  return Line{line[0], line[1]};
}

/// Four times, from the second time on without the worst.
std::optional<Line> robust_fit(const std::vector<Pair>& pairs) {
  Line line;
  double limit = infinity;
  for (int round = 0; round < 4; ++round) {
    const std::optional<Line> next = fitted(pairs, line, limit);
    if (!next) return std::nullopt;
    line = *next;
    double sum = 0;
    for (const Pair& p : pairs) sum += line.residual(p);
    limit = 2 * sum / static_cast<double>(pairs.size());
  }
  return line;
}

std::optional<Finding> related(const Truth& truth, const OtherMap& other,
                               const Relation& relation) {
  const std::vector<Pair> pairs = pairs_of(truth, other, relation);
  const std::optional<Line> line = robust_fit(pairs);
  if (!line || !(std::abs(line->alpha) > 0)) return std::nullopt;
  std::uint64_t agreeing = 0;
  for (const Pair& p : pairs) {
    const double depth = from(relation.depth, (p.y - line->beta) / line->alpha);
    if (std::abs(depth - p.depth) <= agreement * p.depth) ++agreeing;
  }
  const auto needed = agreeing_share * static_cast<double>(pairs.size());
  if (static_cast<double>(agreeing) < needed) return std::nullopt;
  return Finding{relation.kind, fmt::format(fmt::runtime(relation.text), line->alpha, line->beta),
                 agreeing};
}

}  // namespace

std::optional<Finding> related_depths(const Truth& truth, const OtherMap& other) {
  for (const Relation& relation : relations) {
    if (auto finding = related(truth, other, relation)) return finding;
  }
  return std::nullopt;
}

}  // namespace fathom::attribution
