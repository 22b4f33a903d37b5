// fathom scan --algorithm NAME [FILE]

#include <fmt/core.h>

#include <memory>

#include "apps/shell/output_place.h"
#include "apps/shell/text_output.h"
#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/cases/steps_picture.h"
#include "apps/textbook/drawing/scan_drawing.h"
#include "apps/textbook/scan/edge_values.h"
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

/// What an algorithm's answer has, and so which options it takes.
struct Answers {
  bool pixels = false;     ///< --runs
  bool steps = false;      ///< --trace
  bool triangles = false;  ///< --subpixel-bits
  bool ties = false;       ///< --ties
  bool edges = false;      ///< --edges
  bool values = false;     ///< --values
};
constexpr Answers drawing{.pixels = true, .steps = true};
constexpr Answers stepping{.pixels = true, .steps = true, .ties = true};
constexpr Answers triangle{.pixels = true, .steps = true, .triangles = true};
constexpr Answers half_planes{.pixels = true, .steps = true, .triangles = true, .edges = true};
constexpr Answers filling{.pixels = true};
constexpr Answers valuing{.triangles = true, .values = true};
constexpr Answers question{};

/// An algorithm over each arithmetic.
struct ScanAlgorithm {
  Algorithm exact, float64, float32;
  Answers answers;
};

#define FATHOM_SCAN(name) scan::name<Exact>, scan::name<double>, scan::name<float>
ScanAlgorithm parse_algorithm(const std::string& text) {
  return parse_word<ScanAlgorithm>(
      text, {{"explicit", {FATHOM_SCAN(explicit_line), stepping}},
             {"dda", {FATHOM_SCAN(dda), stepping}},
             {"bresenham", {FATHOM_SCAN(bresenham), stepping}},
             {"midpoint", {FATHOM_SCAN(midpoint), stepping}},
             {"diamond-exit", {FATHOM_SCAN(diamond_exit), drawing}},
             {"line-forms", {FATHOM_SCAN(line_forms), question}},
             {"even-odd", {FATHOM_SCAN(even_odd), drawing}},
             {"non-zero", {FATHOM_SCAN(non_zero), drawing}},
             {"flood", {scan::flood, scan::flood, scan::flood, filling}},
             {"edge-function", {FATHOM_SCAN(edge_function), half_planes}},
             {"scan-line", {FATHOM_SCAN(scan_line), triangle}},
             {"edge-values", {FATHOM_SCAN(edge_values), valuing}},
             {"inside", {FATHOM_SCAN(inside), question}},
             {"convexity", {FATHOM_SCAN(convexity), question}},
             {"tessellate", {scan::tessellate, scan::tessellate, scan::tessellate, question}},
             {"convex-hull", {FATHOM_SCAN(convex_hull), question}}});
}
#undef FATHOM_SCAN

/// What --algorithm names: how it is spelt, and what it is.
struct NamedAlgorithm {
  std::string name;
  ScanAlgorithm algorithm{};
};

NamedAlgorithm parse_named(const std::string& text) {
  return {text, parse_algorithm(text)};
}

enum class Arithmetic { exact, float64, float32 };

Arithmetic parse_arithmetic(const std::string& text) {
  return parse_word<Arithmetic>(text, {{"exact", Arithmetic::exact},
                                       {"float64", Arithmetic::float64},
                                       {"float32", Arithmetic::float32}});
}

int parse_subpixel_bits(const std::string& text) {
  const std::int64_t bits = parse_whole(text);
  if (bits < 0 || bits > pipeline::most_subpixel_bits)
    throw UsageError(fmt::format("{} is not between 0 and 16", bits));
  return static_cast<int>(bits);
}

pipeline::TieRule parse_ties(const std::string& text) {
  using enum pipeline::TieRule;
  return parse_word<pipeline::TieRule>(text,
                                       {{"greater", greater}, {"even", even}, {"stay", stay}});
}

pipeline::EdgeRule parse_edges(const std::string& text) {
  using enum pipeline::EdgeRule;
  return parse_word<pipeline::EdgeRule>(text, {{"top-left", top_left}, {"closed", closed}});
}

struct ScanArguments {
  NamedAlgorithm algorithm;
  Arithmetic arithmetic = Arithmetic::exact;
  Form form;
  std::string draw, values;
  std::string file = "-";
};

std::string parse_values_name(const std::string& text) {
  if (!text.ends_with(".csv") && !text.ends_with(".npy"))
    throw UsageError("'" + text + "' does not end in .csv or .npy");
  return text;
}

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

/// Refuses options that would change nothing.
void check(const ScanArguments& arguments) {
  const auto& [name, algorithm] = arguments.algorithm;
  const Form& form = arguments.form;
  if (form.subpixel_bits && !algorithm.answers.triangles)
    throw UsageError("--subpixel-bits is for triangles: edge-function and scan-line");
  if (form.ties && !algorithm.answers.ties)
    throw UsageError("--ties is for lines: explicit, dda, bresenham and midpoint");
  if (form.edges && !algorithm.answers.edges) throw UsageError("--edges is for edge-function");
  if (form.runs && !algorithm.answers.pixels)
    throw UsageError(fmt::format("--runs: {} draws no pixels; leave the option out", name));
  if (form.numbers.trace && !algorithm.answers.steps)
    throw UsageError(fmt::format("--trace: {} shows no steps; leave the option out", name));
  if (!arguments.draw.empty() && !algorithm.answers.steps && !algorithm.answers.values)
    throw UsageError(fmt::format("--draw: {} shows no steps; leave the option out", name));
  if (!arguments.draw.empty() && form.runs)
    throw UsageError("--draw shows pixels; leave --runs out");
  if (!arguments.values.empty() && !algorithm.answers.values)
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
    if (picture_.is_wanted() && arguments_.algorithm.algorithm.answers.steps)
      form.numbers.trace = true;
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
  const Algorithm scan_case = in_arithmetic(arguments.algorithm.algorithm, arguments.arithmetic);
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
      "scan", "Rasterize lines, polygons and triangles given as JSON lines",
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
      "docs/scan.md has every algorithm's keys, answer and trace.");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, parse_named),
              "Lines: explicit, dda, bresenham, midpoint (ends are pixels), diamond-exit (ends are "
              "places, (0, 0) is a corner), line-forms; polygons: even-odd, non-zero, inside, "
              "convexity, tessellate; points: convex-hull; triangles: edge-function, scan-line, "
              "edge-values (the three edge functions over the whole image); grids: flood")
      .required();
  command.option("--arithmetic", "NAME", into(arguments->arithmetic, parse_arithmetic),
                 "exact (default), float64 or float32; bresenham, midpoint, flood and tessellate "
                 "are exact with each of them");
  command.option("--subpixel-bits", "N", into(arguments->form.subpixel_bits, parse_subpixel_bits),
                 "Snap triangles to 2^N positions a pixel, 0 to 16 (default: no snapping)");
  command.option(
      "--ties", "RULE", into(arguments->form.ties, parse_ties),
      "Decide which pixel a line takes half way between two: greater (default), even (as "
      "Python's round) or stay (as the textbooks' Bresenham)");
  command.option("--edges", "RULE", into(arguments->form.edges, parse_edges),
                 "Decide whose the centres on an edge are: top-left (default) or closed (every "
                 "triangle's, as the textbooks' >= 0)");
  command.flag("--runs", arguments->form.runs,
               "Write runs [y, x_begin, x_end] instead of pixels, x_end exclusive");
  command.flag("--exact", arguments->form.numbers.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.numbers.trace,
               "Add how pixels were decided: decision variables, crossings, slopes, ends of spans, "
               "edge functions");
  command.option("--draw", "FILE.svg", into(arguments->draw, cases::parse_svg_name),
                 "Draw the steps: decision values along a line, crossings of each scan line, edge "
                 "functions at each pixel");
  command.option("--values", "FILE", into(arguments->values, parse_values_name),
                 "With edge-values: write the values of one case as .csv or .npy");
  command.argument("FILE", arguments->file,
                   "Cases, one a line; standard input where it is - or missing");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) { return run_scan(*arguments); });
}

}  // namespace fathom::app
