#pragma once

#include <cstdlib>

namespace fathom::checks {

/// Sanitizers make the code ten to fifty times slower: fewer of the random cases are run under
/// them, of the same kinds.
#if defined(FATHOM_SANITIZED)
inline constexpr int effort = 20;
#else
inline constexpr int effort = 1;
#endif

/// Whether long tests draw all of their cases: if FATHOM_ALL_CASES is set, as scripts/check-long
/// does. Otherwise they draw a share, so that .ci/run stays short.
inline bool draws_all_cases() {
  return std::getenv("FATHOM_ALL_CASES") != nullptr;
}

/// The number of cases of such a test: all of them, or one of `shares` equal shares.
inline int cases_to_draw(int all, int shares) {
  return (draws_all_cases() ? all : all / shares) / effort;
}

}  // namespace fathom::checks
