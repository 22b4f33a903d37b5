// Ctrl-C ends a call of fathom.scan in Python: every algorithm of scan checks for interruption.

#include <gtest/gtest.h>

#include <atomic>

#include "apps/textbook/scan/scan_cases.h"
#include "fathom/threads/interruption.h"

namespace fathom::app::scan {
namespace {

TEST(ScanInterruption, EndsEveryAlgorithm) {
  const std::string line = R"({"line": [0,0,9,4]})", triangle = R"({"triangle": [[0,0],[9,1],[2,9]],
      "width": 9, "height": 9})",
                    polygon = R"({"polygon": [[[0,0],[9,1],[2,9]]]})";
  const std::pair<const char*, std::string> cases[] = {
      {"explicit", line},
      {"dda", line},
      {"bresenham", line},
      {"midpoint", line},
      {"diamond-exit", line},
      {"line-forms", line},
      {"even-odd", polygon},
      {"non-zero", polygon},
      {"flood", R"({"grid": ["..", ".."], "seed": [0, 0]})"},
      {"edge-function", triangle},
      {"scan-line", triangle},
      {"edge-values", triangle},
      {"inside", R"({"polygon": [[[0,0],[9,1],[2,9]]], "points": [[1,1]]})"},
      {"convexity", polygon},
      {"tessellate", polygon},
      {"convex-hull", R"({"points": [[0,0],[9,1],[2,9]]})"}};
  EXPECT_EQ(std::size(cases), algorithm_names().size());
  const std::atomic<bool> asked = true;
  for (const auto& [name, text] : cases) {
    for (const Arithmetic arithmetic :
         {Arithmetic::exact, Arithmetic::float64, Arithmetic::float32}) {
      const Algorithm algorithm = in_arithmetic(parse_algorithm(name), arithmetic);
      const Json object = Json::parse(text);
      EXPECT_NO_THROW(algorithm(object, {})) << name;
      const Interruptible here(&asked);
      EXPECT_THROW(algorithm(object, {}), Interrupted) << name;
    }
  }
}

}  // namespace
}  // namespace fathom::app::scan
