#include "fathom/attribution/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/pixels/pixel_judge.h"
#include "fathom/attribution/robust_statistics.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"
#include "fathom/threads/threads.h"

namespace fathom::attribution {

std::string name_of(PixelClass pixel_class) {
  constexpr const char* names[] = {
      "equal",   "within quantization", "within arithmetic", "edge",
      "z-fight", "missed surface",      "convention",        "unexplained"};
  return names[static_cast<std::size_t>(pixel_class)];
}

namespace {

double median_or_zero(std::vector<double>& values) {
  return values.empty() ? 0 : median_of(values);
}

void set_images(const std::vector<PixelResult>& pixels, Attribution& result) {
  const std::size_t count = pixels.size();
  result.classes.resize(count);
  result.least.assign(count, std::numeric_limits<float>::quiet_NaN());
  result.greatest = result.least;
  result.clues.absent.resize(count);
  result.clues.alone.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PixelResult& p = pixels[i];
    result.classes[i] = p.pixel_class;
    result.clues.absent[i] = p.absent;
    result.clues.alone[i] = p.alone ? 1 : 0;
    ++result.counts[static_cast<std::size_t>(p.pixel_class)];
    result.clues.wrong_ties += p.wrong_tie ? 1 : 0;
    if (!p.visible) continue;
    result.least[i] = static_cast<float>(p.visible->depths.lower);
    result.greatest[i] = static_cast<float>(p.visible->depths.upper);
  }
}

double share(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? 0 : static_cast<double>(part) / static_cast<double>(of);
}

Sharpness sharpness_of(const std::vector<PixelResult>& pixels) {
  std::vector<double> widths, steps;
  std::uint64_t may = 0, touched = 0, surfaces = 0, loose = 0;
  for (const PixelResult& p : pixels) {
    may += p.may ? 1 : 0;
    touched += p.touched ? 1 : 0;
    surfaces += p.shows_surface ? 1 : 0;
    loose += p.loose ? 1 : 0;
    if (!p.visible || !(p.visible->relative_width >= 0)) continue;  // no width between infinities
    widths.push_back(p.visible->relative_width);
    steps.push_back(p.visible->steps_width);
  }
  return {.median_relative_width = median_or_zero(widths),
          .median_steps_width = median_or_zero(steps),
          .may_share = share(may, touched),
          .loose_share = share(loose, surfaces)};
}

DepthErrors errors_of(const std::vector<PixelResult>& pixels) {
  DepthErrors errors;
  std::vector<double> relative;
  double sum = 0;
  for (const PixelResult& p : pixels) {
    if (!p.error) continue;
    ++errors.pixels;
    sum += p.error->absolute;
    errors.greatest = std::max(errors.greatest, p.error->absolute);
    errors.greatest_relative = std::max(errors.greatest_relative, p.error->relative);
    relative.push_back(p.error->relative);
  }
  errors.mean = relative.empty() ? 0 : sum / static_cast<double>(relative.size());
  errors.median_relative = median_or_zero(relative);
  return errors;
}

/// Of the pixels of a triangle: stored minus expected, how much of that roundings may be that all
/// triangles share, and the widths of the intervals, in steps.
struct TriangleBias {
  double sum = 0, shared = 0, widths = 0;
  std::uint32_t pixels = 0;
};

/// The pixels of a triangle share the roundings of its corners and plane. Therefore triangles are
/// averaged, each weighted with the inverse square of the uncertainty of its depth.
Bias mean_bias(const std::vector<TriangleBias>& triangles) {
  Bias bias;
  std::vector<std::pair<double, double>> means;  // and weights
  double weights = 0, sum = 0, shared = 0;
  for (const TriangleBias& t : triangles) {
    if (t.pixels == 0 || !(t.widths > 0) || std::isinf(t.widths)) continue;
    const double weight = std::pow(t.pixels / t.widths, 2);
    means.emplace_back(t.sum / t.pixels, weight);
    weights += weight;
    sum += weight * means.back().first;
    shared += weight * t.shared / t.pixels;
  }
  bias.triangles = means.size();
  if (means.size() < 2) return bias;
  bias.steps = sum / weights;
  bias.shared = shared / weights;
  double squares = 0;
  for (const auto& [mean, weight] : means) {
    squares += std::pow(weight * (mean - bias.steps), 2);
  }
  bias.deviation = std::sqrt(squares) / weights;
  return bias;
}

Bias bias_of(const std::vector<PixelResult>& pixels, const Truth& truth) {
  std::uint64_t count = 0;
  std::vector<TriangleBias> triangles(truth.mesh.triangles.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelResult& p = pixels[i];
    if (!p.bias) continue;
    ++count;
    TriangleBias& bias = triangles[truth.triangles[i]];
    bias.sum += p.bias->off;
    bias.shared += p.bias->shared;
    bias.widths += p.visible->steps_width;
    ++bias.pixels;
  }
  Bias bias = mean_bias(triangles);
  bias.pixels = count;
  return bias;
}

/// The numbers of all pixels, in the order of the pixels, whichever threads judged them.
Attribution summary_of(const std::vector<PixelResult>& pixels, const Truth& truth) {
  Attribution result;
  set_images(pixels, result);
  result.sharpness = sharpness_of(pixels);
  result.errors = errors_of(pixels);
  result.bias = bias_of(pixels, truth);
  return result;
}

/// The fragments of all triangles at the pixels of some rows, pixel by pixel.
std::vector<std::vector<Fragment>> fragments_in(const FragmentSource& source,
                                                const std::vector<PixelBox>& boxes,
                                                std::uint32_t width, std::uint32_t first_row,
                                                std::uint32_t last_row) {
  std::vector<std::vector<Fragment>> found(std::size_t{width} * (last_row - first_row + 1));
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    PixelBox box = boxes[t];
    if (box.is_empty() || box.first_row > last_row || box.last_row < first_row) continue;
    box.first_row = std::max(box.first_row, first_row);
    box.last_row = std::min(box.last_row, last_row);
    source.each(t, box, [&](std::uint32_t column, std::uint32_t row, const Fragment& f) {
      found[std::size_t{row - first_row} * width + column].push_back(f);
    });
  }
  return found;
}

}  // namespace

Attribution attribute_bands(const Truth& truth, const OtherMap& other, const RendererModel& model,
                            const std::vector<std::uint32_t>& bands) {
  const StandardArithmetic standard;
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  const auto source = fragments(truth.mesh, truth.camera, model);
  std::vector<PixelBox> boxes(truth.mesh.triangles.size());
  parallel_for(std::size_t{0}, boxes.size(),
               [&](std::size_t t) { boxes[t] = source->box(static_cast<std::uint32_t>(t)); });

  const PixelJudge judge(truth, other, model);
  std::vector<PixelResult> pixels(std::size_t{width} * height);
  parallel_for(std::size_t{0}, bands.size(), [&](std::size_t k) {
    const std::uint32_t first = bands[k] * rows_per_band;
    const std::uint32_t last = std::min(first + rows_per_band, height) - 1;
    const auto found = fragments_in(*source, boxes, width, first, last);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t index = std::size_t{first} * width + i;
      pixels[index] = judge.judge(index, found[i]);
    }
  });
  return summary_of(pixels, truth);
}

Attribution attribute(const Truth& truth, const OtherMap& other, const RendererModel& model) {
  const StandardArithmetic standard;
  std::vector<std::uint32_t> bands((truth.camera.height + rows_per_band - 1) / rows_per_band);
  std::iota(bands.begin(), bands.end(), 0U);
  return attribute_bands(truth, other, model, bands);
}

namespace {

std::string depth_text(double depth) {
  return std::isfinite(depth) ? fmt::format("{:.9g}", depth) : "background";
}

}  // namespace

std::string pixel_text(const Truth& truth, const OtherMap& other, const Attribution& found,
                       std::size_t pixel) {
  const StandardArithmetic standard;
  std::string text =
      fmt::format("({}, {}): {} instead of {}", pixel % other.width, pixel / other.width,
                  depth_text(other.depths[pixel]), depth_text(truth.depths[pixel]));
  const float least = found.least[pixel], greatest = found.greatest[pixel];
  // Where the renderer may have drawn nothing there is no interval.
  if (std::isfinite(least) && std::isfinite(greatest)) {
    text += fmt::format(", allowed {} to {}", depth_text(least), depth_text(greatest));
  }
  return text;
}

std::string finding_text(const Finding& f) {
  return fmt::format("{} ({})", f.text, text::counted(f.pixels, "pixel"));
}

std::string finding_line(const Finding& f) {
  return f.kind + ": " + finding_text(f);
}

std::string verdict_text(const Truth& truth, const OtherMap& other, const Attribution& found) {
  const StandardArithmetic standard;
  const auto is_undecided = [](const Finding& f) { return f.kind == "undecided"; };
  if (!found.findings.empty()) {
    const Finding& first = found.findings.front();
    return (is_undecided(first) ? "" : "failed: ") + finding_text(first);
  }
  const std::string cause = cause_of(truth, other, found);
  if (!cause.empty()) return "failed: " + cause;
  const auto note = std::find_if(found.notes.begin(), found.notes.end(), is_undecided);
  return note == found.notes.end() ? "every pixel is explained" : finding_text(*note);
}

std::string cause_of(const Truth& truth, const OtherMap& other, const Attribution& found) {
  const StandardArithmetic standard;
  if (!found.findings.empty()) return finding_line(found.findings.front());
  const std::uint64_t unexplained = found.count(PixelClass::unexplained);
  if (unexplained == 0) return "";
  return fmt::format("{} of {} unexplained, the worst {}", unexplained,
                     text::counted(found.classes.size(), "pixel"),
                     pixel_text(truth, other, found, worst_pixels(truth, other, found, 1).front()));
}

namespace {

/// Classes in the order in which they are looked at; 0: not at all.
int urgency(PixelClass c) {
  switch (c) {
    case PixelClass::unexplained:
      return 4;
    case PixelClass::convention:
      return 3;
    case PixelClass::missed:
      return 2;
    case PixelClass::equal:
      return 0;
    default:
      return 1;
  }
}

double relative_error(double truth, double other) {
  if (std::isinf(truth) || std::isinf(other)) return 0;
  return std::abs(other - truth) / truth;
}

}  // namespace

std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count) {
  const StandardArithmetic standard;
  using Rank = std::pair<int, double>;
  std::vector<std::pair<Rank, std::size_t>> ranked;
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    const int rank = urgency(found.classes[i]);
    if (rank > 0) ranked.push_back({{rank, relative_error(truth.depths[i], other.depths[i])}, i});
  }
  count = std::min(count, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                    ranked.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  std::vector<std::size_t> worst;
  for (std::size_t i = 0; i < count; ++i) worst.push_back(ranked[i].second);
  return worst;
}

}  // namespace fathom::attribution
