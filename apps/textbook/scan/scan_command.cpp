// fathom scan --algorithm NAME [FILE]

#include <fmt/format.h>

#include <memory>

#include "apps/shell/numbers.h"
#include "apps/shell/program.h"
#include "apps/textbook/json_lines.h"
#include "apps/textbook/scan/scan_algorithms.h"
#include "fathom/numeric/errors.h"
#include "fathom/pipeline/subpixel_grid.h"

namespace fathom::app {
namespace {

using pipeline::Exact;
using scan::Form;
using scan::Json;
using Algorithm = Json (*)(const Json&, const Form&);

struct NamedAlgorithm {
  const char* name;
  Algorithm exact, float64, float32;
  bool snaps = false;
};

#define FATHOM_SCAN(name, function) \
  { name, scan::function<Exact>, scan::function<double>, scan::function<float> }
constexpr NamedAlgorithm algorithms[] = {
    FATHOM_SCAN("explicit", explicit_line),
    FATHOM_SCAN("dda", dda),
    FATHOM_SCAN("bresenham", bresenham),
    FATHOM_SCAN("midpoint", midpoint),
    FATHOM_SCAN("diamond-exit", diamond_exit),
    FATHOM_SCAN("even-odd", even_odd),
    FATHOM_SCAN("non-zero", non_zero),
    {"flood", scan::flood, scan::flood, scan::flood},
    {"edge-function", scan::edge_function<Exact>, scan::edge_function<double>,
     scan::edge_function<float>, true},
    {"scan-line", scan::scan_line<Exact>, scan::scan_line<double>, scan::scan_line<float>, true},
    FATHOM_SCAN("inside", inside),
    FATHOM_SCAN("convexity", convexity),
    {"tessellate", scan::tessellate, scan::tessellate, scan::tessellate},
    FATHOM_SCAN("convex-hull", convex_hull),
};
#undef FATHOM_SCAN

struct ScanArguments {
  std::string algorithm, arithmetic = "exact", file = "-", subpixel_bits;
  Form form;
};

const NamedAlgorithm& algorithm_named(const std::string& name) {
  std::string names;
  for (const NamedAlgorithm& algorithm : algorithms) {
    if (algorithm.name == name) return algorithm;
    names += (names.empty() ? "" : ", ") + std::string(algorithm.name);
  }
  throw UsageError(fmt::format("--algorithm: '{}' is unknown; there are {}", name, names));
}

Algorithm in_arithmetic(const NamedAlgorithm& algorithm, const std::string& arithmetic) {
  if (arithmetic == "exact") return algorithm.exact;
  if (arithmetic == "float64") return algorithm.float64;
  if (arithmetic == "float32") return algorithm.float32;
  throw UsageError(fmt::format(
      "--arithmetic: '{}' is unknown; there are exact, float64 and float32", arithmetic));
}

int parse_subpixel_bits(const std::string& text) {
  const std::uint32_t bits = parse_count("--subpixel-bits", text);
  if (bits > pipeline::most_subpixel_bits)
    throw UsageError(fmt::format("--subpixel-bits: {} is not between 0 and 16", bits));
  return static_cast<int>(bits);
}

int run_scan(const ScanArguments& arguments) {
  const NamedAlgorithm& named = algorithm_named(arguments.algorithm);
  const Algorithm algorithm = in_arithmetic(named, arguments.arithmetic);
  Form form = arguments.form;
  if (!arguments.subpixel_bits.empty()) {
    if (!named.snaps)
      throw UsageError("--subpixel-bits is for triangles: edge-function and scan-line");
    form.subpixel_bits = parse_subpixel_bits(arguments.subpixel_bits);
  }
  return answer_lines(arguments.file, [&](const Json& object) { return algorithm(object, form); });
}

}  // namespace

void add_scan(Program& program) {
  const auto arguments = std::make_shared<ScanArguments>();
  CLI::App* command = program.add_command(
      "scan", "Rasterize lines, polygons and triangles given as JSON lines",
      "  echo '{\"line\": [0,0,8,3]}' | fathom scan --algorithm midpoint --trace\n"
      "  echo '{\"line\": [0,0,2147483648,7], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm dda --arithmetic float32\n"
      "  echo '{\"polygon\": [[[1,1],[8,2],[4,7]]], \"width\": 9, \"height\": 9}' |\n"
      "    fathom scan --algorithm even-odd --runs\n"
      "  echo '{\"triangle\": [[1,1],[8,2],[4,7]], \"attributes\": [[0],[1],[2]]}' |\n"
      "    fathom scan --algorithm edge-function --subpixel-bits 8");
  command
      ->add_option("--algorithm", arguments->algorithm,
                   "Lines: explicit, dda, bresenham, midpoint, diamond-exit; polygons: even-odd, "
                   "non-zero, inside, convexity, tessellate; points: convex-hull; triangles: "
                   "edge-function, scan-line; grids: flood")
      ->required();
  command->add_option("--arithmetic", arguments->arithmetic,
                      "exact (default), float64 or float32; bresenham, midpoint and flood are "
                      "integers in each");
  command->add_option("--subpixel-bits", arguments->subpixel_bits,
                      "Snap triangles to 2^N positions a pixel, 0 to 16 (default: not at all)");
  command->add_flag("--runs", arguments->form.runs,
                    "Write runs [y, x_begin, x_end] instead of pixels, x_end exclusive");
  command->add_flag("--exact", arguments->form.numbers.exact, "Write numbers as \"p/q\"");
  command->add_flag("--trace", arguments->form.numbers.trace,
                    "Add decision variables, crossings, slopes and ends of spans");
  command->add_option("FILE", arguments->file, "Cases, one a line; - or none: standard input");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_scan(*arguments); }; });
}

}  // namespace fathom::app
