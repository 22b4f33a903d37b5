#pragma once

#include <string>
#include <vector>

#include "apps/validate/faults/fault_study.h"

/// Verdicts on the catalogue's faults, as tables.
namespace fathom::validation {

/// A fault of one size in one renderer's map of one scene.
struct FaultCase {
  const Fault* fault = nullptr;
  std::string scene, renderer;
  /// Reason for a missing map, in one line; empty if the map exists.
  std::string failure;
  FaultResult result;
};

/// A right map and its findings, which should be empty.
struct RightCase {
  std::string scene, renderer, failure, said;
};

struct FaultStudy {
  std::vector<RightCase> right;
  std::vector<FaultCase> faults;

  /// Nothing is found in right maps, and all faults are found and rightly named whose effect is
  /// three times the model's bound or more.
  [[nodiscard]] bool is_good() const;
};

/// Least effect with which a fault must be found and rightly named, in half widths of the model's
/// intervals.
inline constexpr double effect_to_be_named = 3;

/// A line for each right map with a finding and for each fault that is not rightly named.
std::string lines_of(const FaultStudy& study);
/// A row for each fault, a column for each renderer: the least effect from which on it is always
/// found and rightly named; and what comparing pictures sees of it.
std::string to_markdown(const FaultStudy& study);
std::string to_json(const FaultStudy& study);

}  // namespace fathom::validation
