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

/// A result in both runs. Of `before` and `after` the one that there is not has nothing but names.
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
  /// Why the run is worse, in one line: its first clause. Empty where it is not.
  [[nodiscard]] std::string regression() const;
  /// Why results are not compared though there is a baseline, in one clause: one of them is
  /// incomparable, or the baseline has none of them. A gate would let all through there. Empty
  /// where all is well.
  [[nodiscard]] std::string obstacle() const;
};

/// Results are paired by scene, renderer and variant. Findings are the same where their kind is.
Comparison compare(const Report& before, const Report& after);

/// Lines for the terminal: what is worse, better, new, gone, not comparable, each named; the last
/// counts them. Results that are as they were are only counted.
std::string lines_of(const Comparison& comparison);

}  // namespace fathom::validation
