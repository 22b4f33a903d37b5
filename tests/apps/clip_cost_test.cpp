// fathom clip: small cases that would cost much.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_cost.h"

namespace fathom::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

Outcome clip(const std::string& algorithm, const std::string& cases,
             std::vector<std::string> options = {}) {
  const TestFolder folder;
  options.insert(options.begin(), {"clip", "--algorithm", algorithm});
  RunOptions run = at_small_cost(folder);
  run.input = cases;
  return run_fathom(options, run);
}

TEST(ClipCost, NestedNamesAreRefused) {
  constexpr std::size_t depth = 100'000;
  const std::string nested = std::string(depth, '[') + std::string(depth, ']');
  for (const char* command : {"clip", "scan"}) {
    const TestFolder folder;
    RunOptions options = at_small_cost(folder);
    options.input = "{\"name\":" + nested + "}\n{\"name\":\"next\"}\n";
    const Outcome outcome = run_fathom(
        {command, "--algorithm", command == std::string("clip") ? "weiler-atherton" : "dda"},
        options);
    expect_one_line(outcome, 3);
    EXPECT_THAT(outcome.err, HasSubstr("line 1: nested more than 100 deep"));
    EXPECT_THAT(outcome.out, HasSubstr("\"name\":\"next\""));
  }
}

TEST(ClipCost, ManyKeysAreRead) {
  std::string keys;
  for (int i = 0; i < 200'000; ++i) keys += ",\"" + std::to_string(i) + "\":0";
  const Outcome outcome = clip("weiler-atherton", "{\"name\":{\"\":0" + keys + "}}\n");
  expect_one_line(outcome, 3);
  EXPECT_THAT(outcome.err, HasSubstr("\"clip\" is missing"));
}

}  // namespace
}  // namespace fathom::test
