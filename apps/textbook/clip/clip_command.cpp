// fathom clip --algorithm NAME [FILE]

#include <memory>
#include <optional>

#include "apps/shell/exit_status.h"
#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "apps/textbook/clip/clip_comparison.h"
#include "apps/textbook/textbook_commands.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using clip::Form;
using clip::Json;
using Algorithm = Json (*)(const Json&, Form);

/// An algorithm over either kernel; `binary64` is null where it has the exact one alone.
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
                                    {"plane", FATHOM_CLIP(plane)},
                                    {"cgal", Kernels{clip::cgal, nullptr}}});
}
#undef FATHOM_CLIP

/// What an option names: how it is spelt, and what it is.
struct NamedAlgorithm {
  std::string name;
  Kernels kernels{};
};

NamedAlgorithm parse_named(const std::string& text) {
  return {text, parse_algorithm(text)};
}

enum class Kernel { exact, binary64 };

Kernel parse_kernel(const std::string& text) {
  return parse_word<Kernel>(text, {{"exact", Kernel::exact}, {"double", Kernel::binary64}});
}

struct ClipArguments {
  NamedAlgorithm algorithm;
  std::optional<NamedAlgorithm> against;
  Kernel kernel = Kernel::exact;
  Form form;
  std::string file = "-";
};

void check(const ClipArguments& arguments) {
  const auto& [name, kernels] = arguments.algorithm;
  if (arguments.kernel == Kernel::binary64 && kernels.binary64 == nullptr)
    throw UsageError("--kernel double: " + name + " clips exactly; leave the option out");
  if (arguments.form.trace && kernels.exact == clip::cgal)
    throw UsageError("--trace: " + name + " shows no steps; weiler-atherton does");
  if (arguments.against && arguments.kernel == Kernel::exact && arguments.against->name == name)
    throw UsageError("--against " + name + ": an algorithm is not compared with itself");
}

/// The other algorithm's answer beside one's own, over the exact kernel.
class Comparison {
 public:
  Comparison(const ClipArguments& arguments, Algorithm algorithm, const Console& console)
      : arguments_(arguments),
        algorithm_(algorithm),
        console_(console),
        names_{arguments.algorithm.name, arguments.against->name} {
    if (arguments.kernel == Kernel::binary64) names_.first += " in binary64";
  }

  /// {"algorithm", "difference"}
  Json compare(const Json& object, std::size_t line) {
    constexpr Form exact{.exact = true};
    const Json own = algorithm_(object, exact);
    const auto difference =
        clip::first_difference(own, arguments_.against->kernels.exact(object, exact), names_);
    if (difference && !differs_)
      console_.note(cases::input_name(arguments_.file) + ": line " + std::to_string(line) + ": " +
                    clip::to_text(*difference, names_));
    differs_ = differs_ || difference;
    return {{"algorithm", names_.second}, {"difference", difference.value_or(nullptr)}};
  }
  [[nodiscard]] bool differs() const { return differs_; }

 private:
  const ClipArguments& arguments_;
  Algorithm algorithm_;
  const Console& console_;
  clip::Names names_;
  bool differs_ = false;
};

int run_clip(const ClipArguments& arguments, const Console& console) {
  check(arguments);
  const Kernels& kernels = arguments.algorithm.kernels;
  const Algorithm algorithm = arguments.kernel == Kernel::exact ? kernels.exact : kernels.binary64;
  std::optional<Comparison> comparison;
  if (arguments.against) comparison.emplace(arguments, algorithm, console);
  const int status = cases::answer_lines(
      arguments.file, cases::AnswerLine([&](const Json& object, std::size_t line) {
        Json answer = algorithm(object, arguments.form);
        if (comparison) answer["against"] = comparison->compare(object, line);
        return answer;
      }));
  return comparison && comparison->differs() ? answer_is_no : status;
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
      "  fathom clip --algorithm weiler-atherton --against cgal data/clipping/degenerate.jsonl");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, parse_named),
              "weiler-atherton, sutherland-hodgman, cohen-sutherland, liang-barsky, homogeneous, "
              "plane or cgal (CGAL's Boolean set operations)")
      .required();
  command.option("--against", "NAME", into(arguments->against, parse_named),
                 "Compare each answer with this algorithm's, exactly, and report the first "
                 "difference; exit status 1 if there is one");
  command.option("--kernel", "NAME", into(arguments->kernel, parse_kernel),
                 "exact (default) or double: the arithmetic to clip with");
  command.flag("--exact", arguments->form.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.trace, "Add the steps that led to the answer");
  command.argument("FILE", arguments->file,
                   "Cases, one a line; standard input where it is - or missing");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_clip(*arguments, console); });
}

}  // namespace fathom::app
