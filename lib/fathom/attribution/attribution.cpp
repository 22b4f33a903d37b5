#include "fathom/attribution/attribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fathom/attribution/pixel_verdict.h"
#include "fathom/attribution/stored_value.h"
#include "fathom/render.h"

// How to read this file: attribute() at the end. Bands of rows, each with the fragments of its
// pixels; judge() says what may be stored, classify() what was.
namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t rows_per_band = 8;

/// How much farther than the visible surface all others have to be, in window depth, for a pixel
/// to count in the mean of stored minus exact.
constexpr double extra_for_bias = 1e-3;

using Fragments = std::vector<Fragment>;

/// What is asked at one pixel.
struct Pixel {
  std::size_t index = 0;
  const Fragments* fragments = nullptr;
  PixelVerdict verdict;
  const Fragment* visible = nullptr;  ///< the fragment of the visible triangle
};

/// What one pixel adds to the statistics.
struct PixelResult {
  PixelClass pixel_class = PixelClass::equal;
  bool may = false, touched = false, wrong_tie = false;
  double relative_width = -1, steps_width = -1, error = -1, relative_error = -1;
  double bias = 0;
  bool counts_for_bias = false;
};

class Judge {
 public:
  Judge(const Truth& truth, const OtherMap& other, const RendererModel& model, Attribution& result)
      : truth_(truth),
        other_(other),
        model_(model),
        values_(truth.camera, other, model),
        result_(result) {}

  PixelResult pixel(std::size_t index, Fragments& fragments);

 private:
  [[nodiscard]] const Fragment* explaining(const Pixel& p, double stored) const;
  [[nodiscard]] bool is_later_of_equals(const Pixel& p, const Fragment& f) const;
  [[nodiscard]] bool background_allowed(const Pixel& p) const { return !p.verdict.must; }
  [[nodiscard]] PixelClass classify(const Pixel& p) const;
  [[nodiscard]] PixelClass of_another(const Pixel& p, const Fragment& seen) const;
  [[nodiscard]] PixelClass of_none(const Pixel& p) const;
  void note_unexplained(const Pixel& p, PixelResult& result);
  void measure(const Pixel& p, PixelResult& result);

  const Truth& truth_;
  const OtherMap& other_;
  const RendererModel& model_;
  StoredValues values_;
  Attribution& result_;
};

/// A triangle with the same corners in the same order and a lower number is certain to be seen
/// instead.
bool Judge::is_later_of_equals(const Pixel& p, const Fragment& f) const {
  const auto corners = [&](std::uint32_t triangle) {
    CornerIndices t = truth_.mesh.triangles[triangle];
    for (std::uint32_t& corner : t) corner = truth_.corner_numbers[corner];
    return t;
  };
  return std::any_of(p.fragments->begin(), p.fragments->end(), [&](const Fragment& g) {
    return g.triangle < f.triangle && corners(g.triangle) == corners(f.triangle);
  });
}

/// A fragment that may be what is seen here: the visible triangle where it may be, else the one
/// whose exact value is nearest to what is stored.
const Fragment* Judge::explaining(const Pixel& p, double stored) const {
  const Fragment* best = nullptr;
  for (const Fragment& f : *p.fragments) {
    if (!other_.triangles.empty() && f.triangle != other_.triangles[p.index]) continue;
    const Interval allowed = values_.interval(f);
    if (!(allowed.lower <= stored && stored <= allowed.upper)) continue;
    if (allowed.lower > values_.limit(p.verdict.cap) || stored > values_.limit(p.verdict.cap))
      continue;
    if (!other_.triangles.empty() && model_.first_of_equals && is_later_of_equals(p, f)) continue;
    if (&f == p.visible) return &f;
    const auto distance = [&](const Fragment& g) { return std::abs(values_.exact(g) - stored); };
    if (best == nullptr || distance(f) < distance(*best)) best = &f;
  }
  return best;
}

PixelClass Judge::of_none(const Pixel& p) const {
  if (truth_.triangles[p.index] == no_surface) return PixelClass::equal;
  if (!background_allowed(p)) return PixelClass::unexplained;
  return p.verdict.must_if_watertight ? PixelClass::missed : PixelClass::edge;
}

PixelClass Judge::of_another(const Pixel& p, const Fragment& seen) const {
  if (p.visible == nullptr) return PixelClass::edge;
  if (p.visible->coverage == Coverage::must && seen.coverage == Coverage::must) {
    return PixelClass::z_fight;
  }
  const bool behind = values_.interval(seen).lower > values_.interval(*p.visible).upper;
  if (behind && p.verdict.must_if_watertight && !p.verdict.must) return PixelClass::missed;
  return PixelClass::edge;
}

PixelClass Judge::classify(const Pixel& p) const {
  const double depth = other_.depths[p.index];
  const bool background =
      other_.windows.empty() ? depth == infinity : values_.is_cleared(other_.windows[p.index]);
  if (background) {
    const PixelClass none = of_none(p);
    if (none != PixelClass::unexplained) return none;
    // A surface at the far plane may have been stored as what the buffer is cleared to.
    if (other_.windows.empty() || !explaining(p, values_.other(p.index))) return none;
  }
  const double stored = values_.other(p.index);
  const Fragment* seen = explaining(p, stored);
  if (seen == nullptr) return PixelClass::unexplained;
  if (p.visible != nullptr && seen->triangle == p.visible->triangle) {
    if (values_.is_nearest(p.index, truth_.depths[p.index])) return PixelClass::equal;
    if (values_.is_neighbour(p.index, truth_.depths[p.index])) return PixelClass::quantization;
    return PixelClass::arithmetic;
  }
  if (p.visible != nullptr && values_.is_nearest(p.index, truth_.depths[p.index]) &&
      other_.triangles.empty()) {
    return PixelClass::equal;
  }
  return of_another(p, *seen);
}

/// Whether the pixel would be explained if the visible triangle were not there.
void Judge::note_unexplained(const Pixel& p, PixelResult& result) {
  const std::uint32_t visible = truth_.triangles[p.index];
  if (model_.first_of_equals && !other_.triangles.empty()) {
    const auto shown =
        std::find_if(p.fragments->begin(), p.fragments->end(),
                     [&](const Fragment& f) { return f.triangle == other_.triangles[p.index]; });
    result.wrong_tie = shown != p.fragments->end() && is_later_of_equals(p, *shown);
  }
  if (visible == no_surface || result.wrong_tie) return;
  Fragments others;
  for (const Fragment& f : *p.fragments) {
    if (f.triangle != visible) others.push_back(f);
  }
  Pixel without{p.index, &others,
                judge(others, model_.watertight, truth_.mesh.triangles, truth_.corner_numbers)};
  const bool none = other_.depths[p.index] == infinity;
  const bool explained =
      none ? background_allowed(without) : explaining(without, values_.other(p.index)) != nullptr;
  if (explained) result_.absent[p.index] = visible;
}

void Judge::measure(const Pixel& p, PixelResult& result) {
  result.touched = !p.fragments->empty();
  for (const Fragment& f : *p.fragments) {
    if (f.coverage == Coverage::may && f.value.lower <= p.verdict.cap) result.may = true;
  }
  if (p.visible == nullptr) return;
  const double depth = truth_.depths[p.index];
  const Interval allowed = values_.as_depths(*p.visible);
  result_.least[p.index] = static_cast<float>(allowed.lower);
  result_.greatest[p.index] = static_cast<float>(allowed.upper);
  result.relative_width = (allowed.upper - allowed.lower) / depth;
  result.steps_width = values_.steps(*p.visible, depth);
  const bool same = result.pixel_class <= PixelClass::arithmetic;
  if (same && other_.depths[p.index] < infinity) {
    result.error = std::abs(other_.depths[p.index] - depth);
    result.relative_error = result.error / depth;
  }
  const bool alone =
      p.visible->coverage == Coverage::must &&
      std::all_of(p.fragments->begin(), p.fragments->end(), [&](const Fragment& f) {
        return &f == p.visible || f.value.lower > p.visible->value.upper + extra_for_bias;
      });
  if (alone && model_.kind == RendererModel::Kind::raster && other_.depths[p.index] < infinity) {
    result.counts_for_bias = true;
    result.bias = values_.bias_steps(p.index, *p.visible);
  }
}

PixelResult Judge::pixel(std::size_t index, Fragments& fragments) {
  Pixel p{index, &fragments,
          judge(fragments, model_.watertight, truth_.mesh.triangles, truth_.corner_numbers)};
  for (const Fragment& f : fragments) {
    if (f.triangle == truth_.triangles[index]) p.visible = &f;
  }
  PixelResult result;
  result.pixel_class = classify(p);
  if (result.pixel_class == PixelClass::unexplained) note_unexplained(p, result);
  measure(p, result);
  return result;
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of the pixels of a triangle: stored minus expected and the widths of the intervals, in steps.
struct TriangleBias {
  double sum = 0, widths = 0;
  std::uint32_t pixels = 0;
};

/// Roundings are those of a triangle's corners and plane: its pixels share them, so triangles are
/// what is averaged, each with the inverse square of how uncertain its depth is.
void set_bias(const std::vector<TriangleBias>& triangles, Attribution& result) {
  std::vector<std::pair<double, double>> means;  // and weights
  double weights = 0, sum = 0;
  for (const TriangleBias& t : triangles) {
    if (t.pixels == 0 || !(t.widths > 0) || std::isinf(t.widths)) continue;
    const double weight = std::pow(t.pixels / t.widths, 2);
    means.emplace_back(t.sum / t.pixels, weight);
    weights += weight;
    sum += weight * means.back().first;
  }
  result.bias_triangles = means.size();
  if (means.size() < 2) return;
  result.bias_steps = sum / weights;
  double squares = 0;
  for (const auto& [mean, weight] : means) {
    squares += std::pow(weight * (mean - result.bias_steps), 2);
  }
  result.bias_deviation = std::sqrt(squares) / weights;
}

void summarise(const std::vector<PixelResult>& pixels, const Truth& truth, Attribution& result) {
  std::vector<double> widths, steps, relative;
  std::uint64_t may = 0, touched = 0;
  double sum = 0;
  std::vector<TriangleBias> biases(truth.mesh.triangles.size());
  result.certain_pixels.assign(truth.mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelResult& p = pixels[i];
    result.classes[i] = p.pixel_class;
    ++result.counts[static_cast<std::size_t>(p.pixel_class)];
    may += p.may ? 1 : 0;
    touched += p.touched ? 1 : 0;
    result.wrong_ties += p.wrong_tie ? 1 : 0;
    if (p.relative_width >= 0) {
      widths.push_back(p.relative_width);
      steps.push_back(p.steps_width);
      if (!p.may) ++result.certain_pixels[truth.triangles[i]];
    }
    if (p.error >= 0) {
      ++result.errors.pixels;
      sum += p.error;
      result.errors.greatest = std::max(result.errors.greatest, p.error);
      result.errors.greatest_relative = std::max(result.errors.greatest_relative, p.relative_error);
      relative.push_back(p.relative_error);
    }
    if (p.counts_for_bias) {
      ++result.bias_pixels;
      TriangleBias& bias = biases[truth.triangles[i]];
      bias.sum += p.bias;
      bias.widths += p.steps_width;
      ++bias.pixels;
    }
  }
  result.median_relative_width = median(widths);
  result.median_steps_width = median(steps);
  result.may_share = touched == 0 ? 0 : static_cast<double>(may) / static_cast<double>(touched);
  result.errors.mean = relative.empty() ? 0 : sum / static_cast<double>(relative.size());
  result.errors.median_relative = median(relative);
  set_bias(biases, result);
}

}  // namespace

std::string name_of(PixelClass pixel_class) {
  constexpr const char* names[] = {
      "equal",   "within quantization", "within arithmetic", "edge",
      "z-fight", "missed surface",      "convention",        "unexplained"};
  return names[static_cast<std::size_t>(pixel_class)];
}

Truth make_truth(const Scene& scene, const Camera& camera) {
  Truth truth{.mesh = world_mesh(scene), .camera = camera};
  truth.corner_numbers = corner_numbers(truth.mesh);
  const DepthMap map =
      render(scene, camera, {.channels = {Channel::Z, Channel::Zlow, Channel::id}});
  const auto& high = *map.values<float>("Z");
  const auto& low = *map.values<float>("Zlow");
  const auto& id = *map.values<std::uint32_t>("id");
  truth.triangles.assign(id.begin(), id.end());
  truth.depths.resize(high.size());
  for (std::size_t i = 0; i < high.size(); ++i) {
    truth.depths[i] = id[i] == no_surface ? infinity : double{high[i]} + double{low[i]};
  }
  return truth;
}

Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  const std::size_t count = std::size_t{width} * height;
  Attribution result;
  result.classes.resize(count);
  result.least.assign(count, std::numeric_limits<float>::quiet_NaN());
  result.greatest = result.least;
  result.absent.assign(count, no_surface);

  const auto source = fragments(truth.mesh, truth.camera, model);
  std::vector<PixelBox> boxes(truth.mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(),
                    [&](std::size_t t) { boxes[t] = source->box(static_cast<std::uint32_t>(t)); });

  Judge judge(truth, other, model, result);
  std::vector<PixelResult> pixels(count);
  const std::uint32_t bands = (height + rows_per_band - 1) / rows_per_band;
  tbb::parallel_for(std::uint32_t{0}, bands, [&](std::uint32_t band) {
    const std::uint32_t first = band * rows_per_band;
    const std::uint32_t last = std::min(first + rows_per_band, height) - 1;
    std::vector<Fragments> found(std::size_t{width} * (last - first + 1));
    for (std::uint32_t t = 0; t < boxes.size(); ++t) {
      PixelBox box = boxes[t];
      if (box.is_empty() || box.first_row > last || box.last_row < first) continue;
      box.first_row = std::max(box.first_row, first);
      box.last_row = std::min(box.last_row, last);
      source->each(t, box, [&](std::uint32_t column, std::uint32_t row, const Fragment& f) {
        found[std::size_t{row - first} * width + column].push_back(f);
      });
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t index = std::size_t{first} * width + i;
      pixels[index] = judge.pixel(index, found[i]);
    }
  });
  summarise(pixels, truth, result);
  return result;
}

}  // namespace fathom::attribution
