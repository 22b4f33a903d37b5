#include "apps/bench/parts/ideas.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "fathom/failures/errors.h"

namespace fathom::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds time_there_is{20};
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
  const std::size_t half = milliseconds.size() / 2;
  return milliseconds.size() % 2 == 1 ? milliseconds[half]
                                      : (milliseconds[half - 1] + milliseconds[half]) / 2;
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
