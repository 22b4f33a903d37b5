#pragma once

#include <gtest/gtest.h>

#include "run_program.h"
#include "test_folder.h"

/// What a small file may cost. The limits are many times what is needed, in any build, and far
/// below what a cost that is quadratic comes to, or one that follows a number in the file.
namespace fathom::test {

inline RunOptions at_small_cost(const TestFolder& folder) {
  RunOptions options{.folder = folder.path()};
#ifndef FATHOM_SANITIZED
  options.memory = rlim_t{2} << 30;
  options.seconds = 20;
#else
  options.seconds = 200;
#endif
  return options;
}

/// Expects a refusal of one line, and nothing else.
inline void expect_one_line(const Outcome& outcome, int status) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("fathom: error: ", 0), 0U) << outcome.err;
}

}  // namespace fathom::test
