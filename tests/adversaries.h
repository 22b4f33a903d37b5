#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/effort.h"

/// How much is done by the tests that draw hard cases from families; their suites have
/// "Adversaries" in their names, so that `ctest -R Adversaries` runs them all.
///   FATHOM_ADVERSARIES    scenes of each family (default 900; scripts/check-long has more); of
///                         other things than scenes a test draws a number in proportion
///   FATHOM_FIRST_SEED     of the first case of each family (default 0)
namespace fathom::checks {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// How many cases a test draws that draws `by_default` of them where nothing else is asked for.
inline std::uint64_t number_of_adversaries(std::uint64_t by_default = 900) {
  const std::uint64_t scenes = from_environment("FATHOM_ADVERSARIES", 900);
  return std::max<std::uint64_t>(1, scenes * by_default / 900 / effort);
}

/// Calls `check` with each seed, until one fails.
template <class Check>
void for_each_adversary(std::uint64_t by_default, const Check& check) {
  const std::uint64_t first = from_environment("FATHOM_FIRST_SEED", 0);
  const std::uint64_t end = first + number_of_adversaries(by_default);
  for (std::uint64_t seed = first; seed < end && !::testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("FATHOM_FIRST_SEED=" + std::to_string(seed));
    check(seed);
  }
}

}  // namespace fathom::checks
