// fathom clip --algorithm NAME [FILE]

#include <fmt/format.h>

#include <memory>

#include "apps/shell/program.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "apps/textbook/json_lines.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using clip::Form;
using clip::Json;
using Algorithm = Json (*)(const Json&, Form);

struct NamedAlgorithm {
  const char* name;
  Algorithm exact, binary64;
};

constexpr NamedAlgorithm algorithms[] = {
    {"weiler-atherton", clip::weiler_atherton<clipping::Rational>, clip::weiler_atherton<double>},
    {"sutherland-hodgman", clip::sutherland_hodgman<clipping::Rational>,
     clip::sutherland_hodgman<double>},
    {"cohen-sutherland", clip::cohen_sutherland<clipping::Rational>,
     clip::cohen_sutherland<double>},
    {"liang-barsky", clip::liang_barsky<clipping::Rational>, clip::liang_barsky<double>},
    {"homogeneous", clip::homogeneous<clipping::Rational>, clip::homogeneous<double>},
    {"plane", clip::plane<clipping::Rational>, clip::plane<double>},
};

struct ClipArguments {
  std::string algorithm, kernel = "exact", file = "-";
  Form form;
};

Algorithm algorithm_named(const std::string& name, const std::string& kernel) {
  if (kernel != "exact" && kernel != "double")
    throw UsageError(fmt::format("--kernel: '{}' is unknown; there are exact and double", kernel));
  std::string names;
  for (const NamedAlgorithm& algorithm : algorithms) {
    if (algorithm.name == name) return kernel == "exact" ? algorithm.exact : algorithm.binary64;
    names += (names.empty() ? "" : ", ") + std::string(algorithm.name);
  }
  throw UsageError(fmt::format("--algorithm: '{}' is unknown; there are {}", name, names));
}

int run_clip(const ClipArguments& arguments) {
  const Algorithm algorithm = algorithm_named(arguments.algorithm, arguments.kernel);
  return answer_lines(arguments.file,
                      [&](const Json& object) { return algorithm(object, arguments.form); });
}

}  // namespace

void add_clip(Program& program) {
  const auto arguments = std::make_shared<ClipArguments>();
  CLI::App* command = program.add_command(
      "clip", "Clip polygons and segments given as JSON lines",
      "  echo '{\"subject\": [[[0,0],[4,0],[4,4],[0,4]]], \"clip\": [[[2,1],[6,1],[2,3]]]}' |\n"
      "    fathom clip --algorithm weiler-atherton --exact\n"
      "  echo '{\"segment\": [[0,0],[9,6]], \"window\": [1,1,6,3]}' |\n"
      "    fathom clip --algorithm cohen-sutherland --trace\n"
      "  fathom clip --algorithm weiler-atherton data/clipping/degenerate.jsonl");
  command
      ->add_option("--algorithm", arguments->algorithm,
                   "weiler-atherton, sutherland-hodgman, cohen-sutherland, liang-barsky, "
                   "homogeneous or plane")
      ->required();
  command->add_option("--kernel", arguments->kernel,
                      "exact (default) or double: the arithmetic to clip with");
  command->add_flag("--exact", arguments->form.exact, "Write numbers as \"p/q\"");
  command->add_flag("--trace", arguments->form.trace, "Add how the answer came about");
  command->add_option("FILE", arguments->file, "Cases, one a line; - or none: standard input");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_clip(*arguments); }; });
}

}  // namespace fathom::app
