#include "apps/bench/parts/ideas.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "apps/bench/measurement.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"

namespace fathom::bench {

using pipeline::PipelineFrame;
using pipeline::PipelineOptions;
using pipeline::PipelineStatistics;

PipelineOptions plain_pipeline() {
  PipelineOptions options;
  options.shading = pipeline::Shading::none;
  return options;
}

Variant pipeline_variant(std::string name, const BenchScene& bench, const PipelineOptions& options,
                         std::function<Counts(const PipelineStatistics&)> counts) {
  const auto frame = std::make_shared<PipelineFrame>();
  const bool with_picture = options.shading != pipeline::Shading::none;
  Variant variant{.name = std::move(name)};
  variant.prepare = [frame] { *frame = {}; };
  variant.draw = [frame, &bench, options, with_picture] {
    *frame = pipeline::render_frame(bench.scene, bench.camera, options, with_picture);
  };
  variant.picture = [frame] {
    Picture picture;
    for (const StoredDepth stored : frame->stored)
      picture.push_back(static_cast<double>(stored.bits));
    for (const auto& colour : frame->picture.pixels)
      picture.insert(picture.end(), colour.begin(), colour.end());
    return picture;
  };
  variant.counts = [frame, counts = std::move(counts)] { return counts(frame->statistics); };
  return variant;
}

Variant fast_variant(std::string name, const BenchScene& bench, const RenderOptions& options,
                     std::function<Counts(const RenderStatistics&)> counts) {
  const auto drawn = std::make_shared<Rendered>();
  Variant variant{.name = std::move(name)};
  variant.prepare = [drawn] { *drawn = {}; };
  variant.draw = [drawn, &bench, options] { *drawn = render(bench.scene, bench.camera, options); };
  variant.picture = [drawn] {
    const Samples<float>& Z = *drawn->map.values<float>("Z");
    return Picture(Z.begin(), Z.end());
  };
  variant.counts = [drawn, counts = std::move(counts)] { return counts(drawn->statistics); };
  return variant;
}

std::shared_ptr<const Picture> picture_of(const Variant& variant) {
  variant.prepare();
  variant.draw();
  return std::make_shared<const Picture>(variant.picture());
}

void add_group(std::vector<Variant>& variants, std::vector<Variant> group) {
  const std::size_t plain = variants.size();
  const auto expected = picture_of(group.front());
  for (Variant& variant : group) {
    variant.plain = plain;
    variant.expected = expected;
    variants.push_back(std::move(variant));
  }
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds enough_for_a_round{30};

/// The least of several times, of as many as there is time for in `enough_for_a_round`: one draw
/// may be so short that losing the processor once would double it.
double time_of(const Variant& variant) {
  double least = std::numeric_limits<double>::infinity();
  const Clock::time_point begin = Clock::now();
  do {
    variant.prepare();
    const Clock::time_point start = Clock::now();
    variant.draw();
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    least = std::min(least, time.count());
  } while (Clock::now() - begin < enough_for_a_round);
  return least;
}

std::size_t differing(const Picture& a, const Picture& b) {
  if (a.size() != b.size()) return std::max(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

/// Draws once and compares.
Counts checked_counts(const Idea& idea, const Variant& variant) {
  variant.prepare();
  variant.draw();
  Counts counts = variant.counts();
  const std::size_t count = differing(variant.picture(), *variant.expected);
  if (variant.may_differ) {
    counts.push_back({"differ", static_cast<double>(count)});
  } else if (count != 0) {
    throw WrongPicture(
        fmt::format("{}, {}: {} values of the picture are wrong", idea.name, variant.name, count));
  }
  return counts;
}

}  // namespace

double VariantTimes::median_ms() const {
  return median_of(milliseconds);
}

IdeaTimes time_idea(const Idea& idea, int repeat) {
  const std::size_t n = idea.variants.size();
  IdeaTimes times{idea.name, idea.note, {}};
  for (const Variant& variant : idea.variants) {
    times.variants.push_back({.name = variant.name,
                              .plain = idea.variants[variant.plain].name,
                              .counts = checked_counts(idea, variant)});
  }
  // The rounds, each beginning with another variant.
  std::vector<std::vector<double>> rounds(n);
  const Clock::time_point start = Clock::now();
  for (int round = 0; round < repeat; ++round) {
    if (round > 0 && Clock::now() - start > time_there_is) break;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = (i + static_cast<std::size_t>(round)) % n;
      rounds[k].push_back(time_of(idea.variants[k]));
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::sort(rounds[k].begin(), rounds[k].end());
    times.variants[k].milliseconds = rounds[k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    times.variants[k].speed_up =
        rounds[idea.variants[k].plain].front() / times.variants[k].milliseconds.front();
  }
  return times;
}

const std::vector<std::string>& idea_names() {
  static const std::vector<std::string> names{"lanes", "blocks",  "early-rejection",
                                              "tiles", "threads", "culling"};
  return names;
}

std::vector<Idea> ideas_named(const std::string& name, const PartsScene& scene,
                              const std::vector<int>& thread_counts) {
  if (name == "lanes") return lanes(scene);
  if (name == "blocks") return blocks(scene);
  if (name == "early-rejection") return early_rejection(scene);
  if (name == "tiles") return tiles(scene);
  if (name == "threads") return threads(scene, thread_counts);
  if (name == "culling") return culling(scene);
  throw UsageError("'" + name + "' is no idea");
}

}  // namespace fathom::bench
