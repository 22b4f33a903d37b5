// fathom scan --algorithm NAME [FILE]

#include <memory>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/drawing/drawings.h"
#include "apps/textbook/scan/scan_cases.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using scan::Algorithm;
using scan::Form;
using scan::Json;

struct ScanArguments {
  scan::NamedAlgorithm algorithm;
  scan::Arithmetic arithmetic = scan::Arithmetic::exact;
  Form form;
  std::string draw, values;
  std::string file = "-";
};

std::string parse_values_name(const std::string& text) {
  if (!text.ends_with(".csv") && !text.ends_with(".npy"))
    throw UsageError("'" + text + "' does not end in .csv or .npy");
  return text;
}

void check(const ScanArguments& arguments) {
  scan::require_effect(arguments.algorithm, arguments.form, !arguments.draw.empty());
  if (!arguments.values.empty() && !arguments.algorithm.answers.values)
    throw UsageError("--values is for edge-values; other algorithms print their answers");
}

/// The files of a run beside its answers: the picture of the steps, the values of one case.
class ScanFiles {
 public:
  explicit ScanFiles(const ScanArguments& arguments)
      : arguments_(arguments), picture_(arguments.draw), values_(arguments.values) {}

  /// The answer as it is printed; what the files need of it is kept.
  Json answer(const Json& object, Algorithm scan_case) {
    Form form = arguments_.form;
    if (picture_.is_wanted() && arguments_.algorithm.answers.steps) form.numbers.trace = true;
    Json answer = scan_case(object, form);
    if (picture_.is_wanted())
      picture_.add(drawing::draw_scan(arguments_.algorithm.name, object, answer));
    if (!arguments_.form.numbers.trace) answer.erase("trace");
    if (!arguments_.values.empty()) keep_values(answer);
    return answer;
  }

  void finish() {
    picture_.finish("fathom scan --algorithm " + arguments_.algorithm.name);
    if (!arguments_.values.empty()) values_.finish(content_);
  }

 private:
  void keep_values(const Json& answer) {
    if (!content_.empty()) throw InputError("--values takes one case; this is the second");
    content_ =
        scan::values_file(answer, arguments_.values.ends_with(".csv") ? scan::ValuesFormat::csv
                                                                      : scan::ValuesFormat::npy);
  }

  const ScanArguments& arguments_;
  cases::StepsPicture picture_;
  TextOutput values_;
  std::string content_;
};

int run_scan(const ScanArguments& arguments) {
  check(arguments);
  const Algorithm scan_case = scan::in_arithmetic(arguments.algorithm, arguments.arithmetic);
  ScanFiles files(arguments);
  const int status = cases::answer_lines(
      arguments.file, [&](const Json& object) { return files.answer(object, scan_case); });
  files.finish();
  return status;
}

}  // namespace

void add_scan(Command& program) {
  const auto arguments = std::make_shared<ScanArguments>();
  Command& command = program.command(
      "scan", description_of_companion("scan"),
      "  echo '{\"line\": [0,0,8,3]}' | fathom scan --algorithm midpoint --trace\n"
      "  echo '{\"line\": [0,0,2147483648,7], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm dda --arithmetic float32\n"
      "  echo '{\"line\": [0,0,8,3], \"points\": [[4,1]], \"parameters\": [0.5]}' |\n"
      "    fathom scan --algorithm line-forms --exact\n"
      "  echo '{\"polygon\": [[[1,1],[8,2],[4,7]]], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm even-odd --runs\n"
      "  echo '{\"polygon\": [[[0,0],[4,0],[4,4],[0,4]]], \"points\": [[1,1],[5,1]]}' |\n"
      "    fathom scan --algorithm inside\n"
      "  echo '{\"points\": [[0,0],[4,0],[0,4]], \"weights\": [1,1,2]}' |\n"
      "    fathom scan --algorithm convex-hull\n"
      "  echo '{\"grid\": [\"..#\",\".#.\"], \"seed\": [0,0], \"connectivity\": 4}' |\n"
      "    fathom scan --algorithm flood\n"
      "  echo '{\"triangle\": [[1,1],[8,2],[4,7]], \"attributes\": [[0],[1],[2]]}' |\n"
      "    fathom scan --algorithm edge-function --subpixel-bits 8\n"
      "  echo '{\"line\": [0,0,8,3]}' | fathom scan --algorithm midpoint --draw line.svg\n"
      "\n"
      "x grows to the right and y down, as on the screen. Pixel (x, y) has its centre at (x + 1/2, "
      "y + 1/2).\n"
      "Counter-clockwise on the screen is positive.\n"
      "Every algorithm's keys, answer and trace: scan.md in the documentation.");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, scan::parse_algorithm),
              "Lines: explicit, dda, bresenham, midpoint (ends are pixels), diamond-exit (ends are "
              "places, (0, 0) is a corner), line-forms; polygons: even-odd, non-zero, inside, "
              "convexity, tessellate; points: convex-hull; triangles: edge-function, scan-line, "
              "edge-values (the three edge functions over the whole image); grids: flood")
      .required();
  command.option("--arithmetic", "NAME", into(arguments->arithmetic, scan::parse_arithmetic),
                 "Arithmetic: exact (default), float64 or float32; bresenham, midpoint, flood and "
                 "tessellate are always exact");
  command.option("--subpixel-bits", "N",
                 into(arguments->form.subpixel_bits, scan::parse_subpixel_bits),
                 "Snap triangles to 2^N positions per pixel, 0 to 16 (default: no snapping)");
  command.option(
      "--ties", "RULE", into(arguments->form.ties, scan::parse_ties),
      "Decide which pixel a line takes half way between two: greater (default), even (as "
      "Python's round) or stay (as the textbooks' Bresenham)");
  command.option("--edges", "RULE", into(arguments->form.edges, scan::parse_edges),
                 "Rule for pixel centres on an edge: top-left (default) or closed (they belong to "
                 "every triangle, as with the textbooks' >= 0)");
  command.flag("--runs", arguments->form.runs,
               "Write runs [y, x_begin, x_end] instead of pixels, x_end exclusive");
  command.flag("--exact", arguments->form.numbers.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.numbers.trace,
               "Add how pixels were decided: decision variables, crossings, slopes, ends of spans, "
               "edge functions");
  command.option("--draw", "SVG", into(arguments->draw, cases::parse_svg_name),
                 "Draw the steps: decision values along a line, crossings of each scan line, edge "
                 "functions at each pixel");
  command.option("--values", "FILE", into(arguments->values, parse_values_name),
                 "With edge-values: write the values of one case as .csv or .npy");
  command.argument("FILE", arguments->file,
                   "File with one case per line (default and -: standard input)");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) { return run_scan(*arguments); });
}

}  // namespace fathom::app
