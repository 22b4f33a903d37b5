#include "fathom/attribution/hypotheses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A model and a map with one thing put right.
struct Hypothesis {
  std::string kind, text;
  RendererModel model;
  OtherMap map;
};

using Question = std::pair<const Truth&, const OtherMap&>;

bool both_see(const Truth& truth, const OtherMap& other, std::size_t i) {
  return truth.depths[i] < infinity && other.depths[i] < infinity;
}

Hypothesis shifted(const OtherMap& other, const RendererModel& model, double dx, double dy) {
  Hypothesis h{"shift",
               fmt::format("the image is shifted by ({:.4g}, {:.4g}) pixels: its samples lie there "
                           "from the centres of the pixels",
                           dx, dy),
               model, other};
  h.model.sample[0] += dx;
  h.model.sample[1] += dy;
  return h;
}

/// The shift that explains the differences of depth best, in least squares: value − exact =
/// g·shift, g from neighbours on the same triangle. Twice, the second time without the worst.
std::optional<std::array<double, 2>> estimated_shift(const Truth& truth, const OtherMap& other) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  // Inverse depths are affine over a triangle (perspective), depths are (orthographic).
  const bool perspective = truth.camera.projection == Projection::perspective;
  const auto affine = [&](double depth) { return perspective ? 1 / depth : depth; };
  std::array<double, 2> shift{0, 0};
  double limit = infinity;
  for (int round = 0; round < 3; ++round) {
    double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0, residuals = 0;
    std::size_t count = 0;
    for (std::uint32_t y = 0; y + 1 < height; ++y) {
      for (std::uint32_t x = 0; x + 1 < width; ++x) {
        const std::size_t i = std::size_t{y} * width + x;
        const bool flat = truth.triangles[i] == truth.triangles[i + 1] &&
                          truth.triangles[i] == truth.triangles[i + width];
        if (!flat || !both_see(truth, other, i)) continue;
        const double here = affine(truth.depths[i]);
        const double gx = affine(truth.depths[i + 1]) - here;
        const double gy = affine(truth.depths[i + width]) - here;
        const double r = affine(other.depths[i]) - here;
        const double residual = std::abs(r - gx * shift[0] - gy * shift[1]);
        if (residual > limit) continue;
        residuals += residual;
        ++count;
        xx += gx * gx;
        xy += gx * gy;
        yy += gy * gy;
        xr += gx * r;
        yr += gy * r;
      }
    }
    const double determinant = xx * yy - xy * xy;
    if (count < 16 || !(determinant > 1e-9 * xx * yy)) return std::nullopt;
    shift = {(yy * xr - xy * yr) / determinant, (xx * yr - xy * xr) / determinant};
    limit = 3 * residuals / static_cast<double>(count);
  }
  if (!(std::hypot(shift[0], shift[1]) < 4)) return std::nullopt;
  return shift;
}

template <class T>
std::vector<T> mirrored_values(const std::vector<T>& values, std::uint32_t width, bool x, bool y) {
  if (values.empty()) return values;
  const std::size_t height = values.size() / width;
  std::vector<T> result(values.size());
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      result[row * width + column] =
          values[(y ? height - 1 - row : row) * width + (x ? width - 1 - column : column)];
    }
  }
  return result;
}

Hypothesis mirrored(const OtherMap& other, const RendererModel& model, bool x, bool y) {
  Hypothesis h{"mirrored",
               std::string("the image is mirrored: ") +
                   (x && y ? "both axes are"
                    : x    ? "the horizontal axis is"
                           : "the vertical axis is") +
                   " flipped",
               model, other};
  h.map.depths = mirrored_values(other.depths, other.width, x, y);
  h.map.windows = mirrored_values(other.windows, other.width, x, y);
  h.map.triangles = mirrored_values(other.triangles, other.width, x, y);
  return h;
}

/// Length of the viewing ray per unit of depth.
double ray_length(const Camera& camera, std::size_t pixel) {
  const std::size_t column = pixel % camera.width, row = pixel / camera.width;
  const double u = static_cast<double>(column) + 0.5;
  const double v = static_cast<double>(row) + 0.5;
  const double y = (v - camera.cy - (0.5 - camera.pixel_centre)) / camera.fy;
  const double x = (u - camera.cx - (0.5 - camera.pixel_centre) - camera.skew * y) / camera.fx;
  return std::sqrt(1 + x * x + y * y);
}

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

/// A finding whose values are only estimated: pixels agree where they do to a thousandth of the
/// disagreement that was there, and in relative terms to 10⁻⁴.
std::optional<Finding> related(const Truth& truth, const OtherMap& other,
                               const Relation& relation) {
  struct Pair {
    double x, y, depth;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    if (!both_see(truth, other, i) || other.depths[i] == 0) continue;
    const double depth = truth.depths[i], stored = other.depths[i];
    if (relation.stored == As::logarithm && !(stored > 0)) continue;
    pairs.push_back({as(relation.depth, depth), as(relation.stored, stored), depth});
  }
  double limit = infinity, alpha = 1, beta = 0;
  for (int round = 0; round < 4; ++round) {
    double n = 0, sx = 0, sy = 0, sum = 0;
    const auto residual = [&](const Pair& p) { return std::abs(p.y - alpha * p.x - beta); };
    for (const Pair& p : pairs) {
      if (round > 0 && residual(p) > limit) continue;
      n += 1;
      sx += p.x;
      sy += p.y;
    }
    if (n < 16) return std::nullopt;
    double xx = 0, xy = 0;
    for (const Pair& p : pairs) {
      if (round > 0 && residual(p) > limit) continue;
      xx += (p.x - sx / n) * (p.x - sx / n);
      xy += (p.x - sx / n) * (p.y - sy / n);
    }
    if (!(xx > 0)) return std::nullopt;
    alpha = xy / xx;
    beta = (sy - alpha * sx) / n;
    for (const Pair& p : pairs) sum += residual(p);
    limit = 2 * sum / static_cast<double>(pairs.size());
  }
  std::uint64_t agreeing = 0;
  for (const Pair& p : pairs) {
    const double depth = from(relation.depth, (p.y - beta) / alpha);
    if (std::abs(depth - p.depth) <= 1e-4 * p.depth) ++agreeing;
  }
  if (static_cast<double>(agreeing) < 0.95 * static_cast<double>(pairs.size())) return std::nullopt;
  if (!(std::abs(alpha) > 0)) return std::nullopt;
  return Finding{relation.kind, fmt::format(fmt::runtime(relation.text), alpha, beta), agreeing};
}

std::vector<std::function<std::optional<Hypothesis>()>> hypotheses(const Truth& truth,
                                                                   const OtherMap& other,
                                                                   const RendererModel& model,
                                                                   const Attribution& found) {
  std::vector<std::function<std::optional<Hypothesis>()>> list;
  list.emplace_back([&]() -> std::optional<Hypothesis> {
    if (!found.is_biased()) return std::nullopt;
    const double steps =
        std::abs(found.bias_steps) < 64 ? std::round(found.bias_steps) : found.bias_steps;
    Hypothesis h{"bias",
                 fmt::format("window depths are biased by {:+.4g} steps of the storage", steps),
                 model, other};
    h.model.bias += steps * storage_step(model, 0.75);
    return h;
  });
  list.emplace_back([&]() -> std::optional<Hypothesis> {
    Hypothesis h{"affine", "depth is interpolated linearly in the image, without perspective",
                 model, other};
    h.model.affine = true;
    return h;
  });
  list.emplace_back([&]() -> std::optional<Hypothesis> {
    const auto shift = estimated_shift(truth, other);
    if (!shift) return std::nullopt;
    return shifted(other, model, (*shift)[0], (*shift)[1]);
  });
  for (const double dx : {-0.5, 0.0, 0.5}) {
    for (const double dy : {-0.5, 0.0, 0.5}) {
      if (dx == 0 && dy == 0) continue;
      list.emplace_back([&other, &model, dx, dy] { return shifted(other, model, dx, dy); });
    }
  }
  for (const int axes : {1, 2, 3}) {
    list.emplace_back([&other, &model, axes] {
      return mirrored(other, model, (axes & 1) != 0, (axes & 2) != 0);
    });
  }
  list.emplace_back([&]() -> std::optional<Hypothesis> {
    if (truth.camera.projection != Projection::perspective) return std::nullopt;
    Hypothesis h{"ray-distance", "distances along the rays are given for planar depths", model,
                 other};
    h.map.windows.clear();
    for (std::size_t i = 0; i < h.map.depths.size(); ++i) {
      h.map.depths[i] /= ray_length(truth.camera, i);
    }
    return h;
  });
  return list;
}

/// The hypothesis that leaves the fewest pixels unexplained becomes a finding, if it leaves few.
bool name_convention(const Truth& truth, const OtherMap& other, const RendererModel& model,
                     Attribution& found) {
  const std::uint64_t before = found.count(PixelClass::unexplained);
  std::uint64_t fewest = before / 10 + 1;
  std::optional<Finding> best;
  Attribution explained;
  for (const auto& make : hypotheses(truth, other, model, found)) {
    const auto h = make();
    if (!h) continue;
    Attribution trial = attribute(truth, h->map, h->model);
    const std::uint64_t left = trial.count(PixelClass::unexplained);
    if (left >= fewest) continue;
    fewest = left;
    best = Finding{h->kind, h->text, before - left};
    explained = std::move(trial);
    if (left == 0) break;
  }
  if (best) {
    for (std::size_t i = 0; i < found.classes.size(); ++i) {
      PixelClass& c = found.classes[i];
      if (c != PixelClass::unexplained || explained.classes[i] == PixelClass::unexplained) continue;
      c = PixelClass::convention;
    }
  } else {
    for (const Relation& relation : relations) {
      best = related(truth, other, relation);
      if (best) break;
    }
    if (!best || best->pixels * 2 < before) return false;
    for (std::size_t i = 0; i < found.classes.size(); ++i) {
      PixelClass& c = found.classes[i];
      if (c == PixelClass::unexplained && both_see(truth, other, i)) c = PixelClass::convention;
    }
  }
  found.counts = {};
  for (const PixelClass c : found.classes) ++found.counts[static_cast<std::size_t>(c)];
  found.findings.push_back(*best);
  return true;
}

/// Triangles that are absent wherever they are certain to be visible.
void name_missing_triangles(const Truth& truth, Attribution& found) {
  std::map<std::uint32_t, std::uint64_t> absent;
  std::map<std::uint32_t, std::uint64_t> present;
  for (std::size_t i = 0; i < found.absent.size(); ++i) {
    const std::uint32_t visible = truth.triangles[i];
    if (visible == no_surface) continue;
    if (found.absent[i] != no_surface) {
      ++absent[visible];
    } else if (found.classes[i] <= PixelClass::arithmetic) {
      ++present[visible];
    }
  }
  for (const auto& [triangle, pixels] : absent) {
    if (present[triangle] > pixels / 10) continue;
    found.findings.push_back(
        {"missing-triangle", fmt::format("triangle {} is missing", triangle), pixels});
  }
}

}  // namespace

Attribution attribute_and_name(const Truth& truth, const OtherMap& other,
                               const RendererModel& model) {
  Attribution found = attribute(truth, other, model);
  const std::uint64_t unexplained = found.count(PixelClass::unexplained);
  if (unexplained == 0) {
    if (found.is_biased()) {
      found.findings.push_back(
          {"bias",
           fmt::format("window depths are biased by {:+.3g} steps of the storage on average",
                       found.bias_steps),
           found.bias_pixels});
    }
    return found;
  }
  if (found.wrong_ties > 0) {
    found.findings.push_back({"ties",
                              "of triangles with the same corners a later one is seen, where the "
                              "first should be",
                              found.wrong_ties});
  }
  name_missing_triangles(truth, found);
  std::uint64_t named = 0;
  for (const Finding& finding : found.findings) named += finding.pixels;
  if (named * 10 < unexplained * 9) {
    std::vector<Finding> few = std::exchange(found.findings, {});
    if (!name_convention(truth, other, model, found)) found.findings = std::move(few);
  }
  return found;
}

}  // namespace fathom::attribution
