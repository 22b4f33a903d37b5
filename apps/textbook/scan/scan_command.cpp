// fathom scan --algorithm NAME [FILE]

#include <fmt/core.h>

#include <memory>

#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/scan/scan_algorithms.h"
#include "apps/textbook/textbook_commands.h"
#include "fathom/numeric/errors.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"

namespace fathom::app {
namespace {

using pipeline::Exact;
using scan::Form;
using scan::Json;
using Algorithm = Json (*)(const Json&, const Form&);

/// An algorithm over each arithmetic.
struct ScanAlgorithm {
  Algorithm exact, float64, float32;
  /// Whether corners can be snapped to the subpixel grid.
  bool snaps = false;
};

#define FATHOM_SCAN(name) scan::name<Exact>, scan::name<double>, scan::name<float>
ScanAlgorithm parse_algorithm(const std::string& text) {
  return parse_word<ScanAlgorithm>(
      text, {{"explicit", {FATHOM_SCAN(explicit_line)}},
             {"dda", {FATHOM_SCAN(dda)}},
             {"bresenham", {FATHOM_SCAN(bresenham)}},
             {"midpoint", {FATHOM_SCAN(midpoint)}},
             {"diamond-exit", {FATHOM_SCAN(diamond_exit)}},
             {"line-forms", {FATHOM_SCAN(line_forms)}},
             {"even-odd", {FATHOM_SCAN(even_odd)}},
             {"non-zero", {FATHOM_SCAN(non_zero)}},
             {"flood", {scan::flood, scan::flood, scan::flood}},
             {"edge-function", {FATHOM_SCAN(edge_function), true}},
             {"scan-line", {FATHOM_SCAN(scan_line), true}},
             {"inside", {FATHOM_SCAN(inside)}},
             {"convexity", {FATHOM_SCAN(convexity)}},
             {"tessellate", {scan::tessellate, scan::tessellate, scan::tessellate}},
             {"convex-hull", {FATHOM_SCAN(convex_hull)}}});
}
#undef FATHOM_SCAN

enum class Arithmetic { exact, float64, float32 };

Arithmetic parse_arithmetic(const std::string& text) {
  return parse_word<Arithmetic>(text, {{"exact", Arithmetic::exact},
                                       {"float64", Arithmetic::float64},
                                       {"float32", Arithmetic::float32}});
}

int parse_subpixel_bits(const std::string& text) {
  const std::uint32_t bits = parse_count(text);
  if (bits > pipeline::most_subpixel_bits) {
    throw UsageError(fmt::format("{} is not between 0 and 16", bits));
  }
  return static_cast<int>(bits);
}

struct ScanArguments {
  ScanAlgorithm algorithm{};
  Arithmetic arithmetic = Arithmetic::exact;
  Form form;
  std::string file = "-";
};

Algorithm in_arithmetic(const ScanAlgorithm& algorithm, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::float64:
      return algorithm.float64;
    case Arithmetic::float32:
      return algorithm.float32;
    default:
      return algorithm.exact;
  }
}

int run_scan(const ScanArguments& arguments) {
  if (arguments.form.subpixel_bits && !arguments.algorithm.snaps) {
    throw UsageError("--subpixel-bits is for triangles: edge-function and scan-line");
  }
  const Algorithm scan_case = in_arithmetic(arguments.algorithm, arguments.arithmetic);
  return cases::answer_lines(arguments.file,
                             [&](const Json& object) { return scan_case(object, arguments.form); });
}

}  // namespace

void add_scan(Command& program) {
  const auto arguments = std::make_shared<ScanArguments>();
  Command& command = program.command(
      "scan", "Rasterize lines, polygons and triangles given as JSON lines",
      "  echo '{\"line\": [0,0,8,3]}' | fathom scan --algorithm midpoint --trace\n"
      "  echo '{\"line\": [0,0,2147483648,7], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm dda --arithmetic float32\n"
      "  echo '{\"line\": [0,0,8,3], \"points\": [[4,1]], \"parameters\": [0.5]}' |\n"
      "    fathom scan --algorithm line-forms --exact\n"
      "  echo '{\"polygon\": [[[1,1],[8,2],[4,7]]], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm even-odd --runs\n"
      "  echo '{\"triangle\": [[1,1],[8,2],[4,7]], \"attributes\": [[0],[1],[2]]}' |\n"
      "    fathom scan --algorithm edge-function --subpixel-bits 8");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, parse_algorithm),
              "Lines: explicit, dda, bresenham, midpoint, diamond-exit, line-forms; polygons: "
              "even-odd, "
              "non-zero, inside, convexity, tessellate; points: convex-hull; triangles: "
              "edge-function, scan-line; grids: flood")
      .required();
  command.option("--arithmetic", "NAME", into(arguments->arithmetic, parse_arithmetic),
                 "exact (default), float64 or float32; bresenham, midpoint and flood compute in "
                 "integers with each of them");
  command.option("--subpixel-bits", "N", into(arguments->form.subpixel_bits, parse_subpixel_bits),
                 "Snap triangles to 2^N positions a pixel, 0 to 16 (default: no snapping)");
  command.flag("--runs", arguments->form.runs,
               "Write runs [y, x_begin, x_end] instead of pixels, x_end exclusive");
  command.flag("--exact", arguments->form.numbers.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.numbers.trace,
               "Add decision variables, crossings, slopes and ends of spans");
  command.argument("FILE", arguments->file,
                   "Cases, one a line; standard input where it is - or missing");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) { return run_scan(*arguments); });
}

}  // namespace fathom::app
