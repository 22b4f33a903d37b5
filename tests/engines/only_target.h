#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace fathom::checks {

/// Restricts the engine to one kind of vector instructions for as long as it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
  }
  ~OnlyTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};

/// All kinds of this machine, one bit each, and the emulation for machines without any.
/// What was not compiled is emulated.
inline std::vector<std::int64_t> vector_targets() {
  std::vector<std::int64_t> all;
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    all.push_back(rest & -rest);
  }
  return all;
}

}  // namespace fathom::checks
