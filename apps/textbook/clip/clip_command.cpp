// fathom clip --algorithm NAME [FILE]

#include <memory>

#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "apps/textbook/textbook_commands.h"

namespace fathom::app {
namespace {

using clip::Form;
using clip::Json;
using Algorithm = Json (*)(const Json&, Form);

/// An algorithm over either kernel.
struct Kernels {
  Algorithm exact, binary64;
};

#define FATHOM_CLIP(name)                              \
  Kernels {                                            \
    clip::name<clipping::Rational>, clip::name<double> \
  }
Kernels parse_algorithm(const std::string& text) {
  return parse_word<Kernels>(text, {{"weiler-atherton", FATHOM_CLIP(weiler_atherton)},
                                    {"sutherland-hodgman", FATHOM_CLIP(sutherland_hodgman)},
                                    {"cohen-sutherland", FATHOM_CLIP(cohen_sutherland)},
                                    {"liang-barsky", FATHOM_CLIP(liang_barsky)},
                                    {"homogeneous", FATHOM_CLIP(homogeneous)},
                                    {"plane", FATHOM_CLIP(plane)}});
}
#undef FATHOM_CLIP

enum class Kernel { exact, binary64 };

Kernel parse_kernel(const std::string& text) {
  return parse_word<Kernel>(text, {{"exact", Kernel::exact}, {"double", Kernel::binary64}});
}

struct ClipArguments {
  Kernels algorithm{};
  Kernel kernel = Kernel::exact;
  Form form;
  std::string file = "-";
};

int run_clip(const ClipArguments& arguments) {
  const Algorithm clip_case =
      arguments.kernel == Kernel::exact ? arguments.algorithm.exact : arguments.algorithm.binary64;
  return cases::answer_lines(arguments.file,
                             [&](const Json& object) { return clip_case(object, arguments.form); });
}

}  // namespace

void add_clip(Command& program) {
  const auto arguments = std::make_shared<ClipArguments>();
  Command& command = program.command(
      "clip", "Clip polygons and segments given as JSON lines",
      "  echo '{\"subject\": [[[0,0],[4,0],[4,4],[0,4]]], \"clip\": [[[2,1],[6,1],[2,3]]]}' |\n"
      "    fathom clip --algorithm weiler-atherton --exact\n"
      "  echo '{\"segment\": [[0,0],[9,6]], \"window\": [1,1,6,3]}' |\n"
      "    fathom clip --algorithm cohen-sutherland --trace\n"
      "  fathom clip --algorithm weiler-atherton data/clipping/degenerate.jsonl");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, parse_algorithm),
              "weiler-atherton, sutherland-hodgman, cohen-sutherland, liang-barsky, homogeneous or "
              "plane")
      .required();
  command.option("--kernel", "NAME", into(arguments->kernel, parse_kernel),
                 "exact (default) or double: the arithmetic to clip with");
  command.flag("--exact", arguments->form.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.trace, "Add the steps that led to the answer");
  command.argument("FILE", arguments->file,
                   "Cases, one a line; standard input where it is - or missing");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) { return run_clip(*arguments); });
}

}  // namespace fathom::app
