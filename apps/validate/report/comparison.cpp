#include "apps/validate/report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "fathom/text/counted.h"

namespace fathom::validation {
namespace {

using attribution::Finding;
using attribution::PixelClass;

const ReportedResult* find(const Report& report, const ReportedResult& like) {
  for (const ReportedResult& r : report.results) {
    if (r.scene == like.scene && r.renderer == like.renderer && r.variant == like.variant)
      return &r;
  }
  return nullptr;
}

/// Findings of `in` of a kind that `known` has none of.
std::vector<Finding> new_findings(const ReportedResult& in, const ReportedResult& known) {
  std::vector<Finding> findings;
  for (const Finding& finding : in.findings) {
    const bool is_known =
        std::any_of(known.findings.begin(), known.findings.end(),
                    [&](const Finding& other) { return other.kind == finding.kind; });
    if (!is_known) findings.push_back(finding);
  }
  return findings;
}

/// Why counts of pixels of the two say nothing about each other; empty where they do.
std::string obstacle_between(const ReportedResult& before, const ReportedResult& after) {
  if (before.width != after.width || before.height != after.height) {
    return fmt::format("{}x{} pixels in the baseline, {}x{} now", before.width, before.height,
                       after.width, after.height);
  }
  if (before.triangles != after.triangles) {
    return fmt::format("a scene of {} in the baseline, of {} now",
                       text::counted(before.triangles, "triangle"), after.triangles);
  }
  return "";
}

void compare_counts(ResultChange& change) {
  for (const PixelClass c : {PixelClass::unexplained, PixelClass::missed, PixelClass::equal}) {
    const auto k = static_cast<std::size_t>(c);
    const std::uint64_t before = change.before.counts[k], after = change.after.counts[k];
    if (before == after) continue;
    const bool is_worse = (c == PixelClass::equal) == (after < before);
    (is_worse ? change.worse : change.better)
        .push_back(fmt::format("{}, {} in the baseline",
                               text::counted(after, attribution::name_of(c) + " pixel"), before));
  }
}

void compare_findings(ResultChange& change) {
  for (const Finding& f : new_findings(change.after, change.before)) {
    change.worse.push_back(f.text);
  }
  for (const Finding& f : new_findings(change.before, change.after)) {
    change.better.push_back("no longer: " + f.text);
  }
}

bool is_same(const ReportedResult& a, const ReportedResult& b) {
  const auto as_tuple = [](const ReportedResult& r) {
    return std::tuple(r.failure, r.counts, r.median_error, r.greatest_error);
  };
  return as_tuple(a) == as_tuple(b);
}

Verdict verdict_on(ResultChange& change) {
  const ReportedResult &before = change.before, &after = change.after;
  if (before.is_done() != after.is_done()) {
    auto& clauses = after.is_done() ? change.better : change.worse;
    clauses.push_back(after.is_done() ? "is drawn; not in the baseline: " + before.failure
                                      : "was drawn in the baseline; now: " + after.failure);
    return after.is_done() ? Verdict::better : Verdict::worse;
  }
  if (after.is_done()) {
    change.obstacle = obstacle_between(before, after);
    if (!change.obstacle.empty()) return Verdict::incomparable;
    compare_findings(change);
    compare_counts(change);
  }
  if (!change.worse.empty()) return Verdict::worse;
  if (!change.better.empty()) return Verdict::better;
  return is_same(before, after) ? Verdict::same : Verdict::changed;
}

/// With the names of `like` and nothing else.
ReportedResult nothing_of(const ReportedResult& like) {
  return {.scene = like.scene, .renderer = like.renderer, .variant = like.variant};
}

struct Lines {
  Verdict verdict;
  const char* heading;
};
constexpr std::array<Lines, 5> told{{{Verdict::worse, "worse than the baseline"},
                                     {Verdict::better, "better than the baseline"},
                                     {Verdict::incomparable, "not comparable with the baseline"},
                                     {Verdict::appeared, "not in the baseline"},
                                     {Verdict::gone, "only in the baseline"}}};
/// Of results that are new or gone, more than these are only counted.
constexpr std::size_t most_named = 8;

}  // namespace

std::string name_of(Verdict verdict) {
  constexpr const char* names[] = {"worse", "better", "changed",       "same",
                                   "new",   "gone",   "not comparable"};
  return names[static_cast<std::size_t>(verdict)];
}

std::size_t Comparison::count(Verdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(changes.begin(), changes.end(),
                    [&](const ResultChange& change) { return change.verdict == verdict; }));
}

std::string Comparison::regression() const {
  for (const ResultChange& change : changes) {
    if (change.verdict == Verdict::worse) {
      return "worse than the baseline: " + title_of(change.after) + ": " + change.worse.front();
    }
  }
  return "";
}

std::string Comparison::obstacle() const {
  for (const ResultChange& change : changes) {
    if (!change.obstacle.empty()) return title_of(change.after) + ": " + change.obstacle;
  }
  const bool none = count(Verdict::appeared) + count(Verdict::gone) == changes.size();
  return none && !changes.empty() ? "contains no result of this run" : "";
}

Comparison compare(const Report& before, const Report& after) {
  Comparison comparison{before.fathom, after.fathom, {}};
  for (const ReportedResult& now : after.results) {
    const ReportedResult* then = find(before, now);
    ResultChange change{.before = then != nullptr ? *then : nothing_of(now), .after = now};
    change.verdict = then != nullptr ? verdict_on(change) : Verdict::appeared;
    comparison.changes.push_back(std::move(change));
  }
  for (const ReportedResult& then : before.results) {
    if (find(after, then) != nullptr) continue;
    comparison.changes.push_back(
        {.before = then, .after = nothing_of(then), .verdict = Verdict::gone});
  }
  return comparison;
}

std::string lines_of(const Comparison& comparison) {
  std::string text;
  for (const auto& [verdict, heading] : told) {
    std::size_t named = 0;
    for (const ResultChange& change : comparison.changes) {
      if (change.verdict != verdict) continue;
      const std::string start = std::string(heading) + ": " + title_of(change.after);
      const auto& clauses = verdict == Verdict::worse ? change.worse : change.better;
      for (const std::string& clause : clauses) text += start + ": " + clause + "\n";
      if (!change.obstacle.empty()) text += start + ": " + change.obstacle + "\n";
      const bool is_named = clauses.empty() && change.obstacle.empty();
      if (is_named && ++named <= most_named) text += start + "\n";
    }
    if (named > most_named) text += fmt::format("{}: {} more\n", heading, named - most_named);
  }
  text += "baseline:";
  for (const Verdict verdict : {Verdict::worse, Verdict::better, Verdict::changed, Verdict::same,
                                Verdict::appeared, Verdict::gone, Verdict::incomparable}) {
    if (verdict != Verdict::worse) text += ",";
    text += fmt::format(" {} {}", comparison.count(verdict), name_of(verdict));
  }
  return text + "\n";
}

}  // namespace fathom::validation
