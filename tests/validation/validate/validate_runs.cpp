#include "tests/validation/validate/validate_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {

nlohmann::json results_of(const std::string& renderers, const std::string& scenes) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(
      {"validate", "--against", renderers, "--scene", scenes, "--size", "64x48", "--out", "report"},
      {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(folder.read("report/report.html"), testing::HasSubstr("</html>"));
  return nlohmann::json::parse(folder.read("report/report.json"))["results"];
}

bool is_multisampled(const nlohmann::json& result) {
  return result["variant"].get<std::string>().find(" samples") != std::string::npos;
}

void expect_explained(const nlohmann::json& result) {
  EXPECT_EQ(result["pixels"]["unexplained"], 0) << result.dump();
  EXPECT_TRUE(result["findings"].empty()) << result.dump();
  EXPECT_LT(result["bounds"]["may_share"], 0.1) << result.dump();
}

}  // namespace fathom::test
