// Linked into each test program by scripts/dev/mutate: which mutants a test reaches is written to a
// file of the test's name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/mutation/mutant.h"

namespace {

class Traces : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    if (std::getenv("FATHOM_MUTANT_TRACE") == nullptr) return;
    std::string name = std::string(test.test_suite_name()) + "." + test.name();
    std::replace(name.begin(), name.end(), '/', '%');
    ::setenv("FATHOM_MUTANT_TEST", name.c_str(), 1);
    fathom_mutant::reached = fathom_mutant::trace_of(name.c_str());
  }
};

// GoogleTest owns it.
const bool added = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new Traces);
  return true;
}();

}  // namespace
