#pragma once

#include <string>
#include <vector>

#include "apps/validate/report/reported_result.h"

/// What changed between two runs of `fathom validate`.
namespace fathom::validation {

enum class Verdict {
  worse,         ///< more unexplained or missed pixels, fewer equal ones, a new finding, not drawn
  better,        ///< the opposite in one of these, and worse in none
  changed,       ///< other counts or errors; neither better nor worse
  same,          ///< the same counts and errors, perhaps of another version
  appeared,      ///< not in the baseline
  gone,          ///< in the baseline only
  incomparable,  ///< another image size or another scene of that name
};

/// "worse", "new", "not comparable", …, as pages show it.
std::string name_of(Verdict verdict);

/// A result in both runs. If a run lacks the result, its `before` or `after` has only names.
struct ResultChange {
  ReportedResult before, after;
  Verdict verdict = Verdict::same;
  /// One clause each, findings first: what got worse, better, or why the two cannot be compared.
  std::vector<std::string> worse, better;
  std::string obstacle;
};

struct Comparison {
  /// Versions of Fathom.
  std::string fathom_before, fathom_after;
  /// The results of this run in their order, then those that are gone.
  std::vector<ResultChange> changes;

  [[nodiscard]] std::size_t count(Verdict verdict) const;
  /// Why the run is worse, in one line: its first clause. Empty if it is not worse.
  [[nodiscard]] std::string regression() const;
  /// Why results are not compared with the baseline, in one clause: a result is incomparable, or
  /// the baseline contains no result of this run. A gate that only looks for regressions would then
  /// let everything pass. Empty if all results are compared.
  [[nodiscard]] std::string obstacle() const;
};

/// Results are paired by scene, renderer and variant. Findings are the same if their kinds are.
Comparison compare(const Report& before, const Report& after);

/// Lines for the terminal. They name the results that are worse, better, new, gone or not
/// comparable; the last line counts them. Unchanged results are only counted.
std::string lines_of(const Comparison& comparison);

}  // namespace fathom::validation
