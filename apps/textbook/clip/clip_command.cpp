// fathom clip --algorithm NAME [FILE]

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "apps/textbook/clip/clip_comparison.h"
#include "apps/textbook/drawing/drawings.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using clip::Form;
using clip::Json;
using Algorithm = Json (*)(const Json&, Form);

/// An algorithm over either kernel; `binary64` is null if it has only the exact kernel. `way` is a
/// key that affects how it finds the answer, not the answer: other algorithms ignore it.
struct Kernels {
  Algorithm exact, binary64;
  std::string_view way = {};
};

#define FATHOM_CLIP(name)                              \
  Kernels {                                            \
    clip::name<clipping::Rational>, clip::name<double> \
  }
Kernels parse_algorithm(const std::string& text) {
  Kernels sutherland_hodgman = FATHOM_CLIP(sutherland_hodgman);
  sutherland_hodgman.way = "decompose";
  return parse_word<Kernels>(text, {{"weiler-atherton", FATHOM_CLIP(weiler_atherton)},
                                    {"sutherland-hodgman", sutherland_hodgman},
                                    {"cohen-sutherland", FATHOM_CLIP(cohen_sutherland)},
                                    {"liang-barsky", FATHOM_CLIP(liang_barsky)},
                                    {"homogeneous", FATHOM_CLIP(homogeneous)},
                                    {"plane", FATHOM_CLIP(plane)},
                                    {"cgal", Kernels{clip::cgal, nullptr}}});
}
#undef FATHOM_CLIP

/// A word of an option: its spelling and its value.
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
  std::string draw;
  std::string file = "-";
};

void check(const ClipArguments& arguments) {
  const auto& [name, kernels] = arguments.algorithm;
  if (arguments.kernel == Kernel::binary64 && kernels.binary64 == nullptr)
    throw UsageError("--kernel double: " + name + " clips exactly; leave the option out");
  if (arguments.form.trace && kernels.exact == clip::cgal)
    throw UsageError("--trace: " + name + " shows no steps; weiler-atherton does");
  if (!arguments.draw.empty() && kernels.exact == clip::cgal)
    throw UsageError("--draw: " + name + " shows no steps; weiler-atherton does");
  if (arguments.against && arguments.kernel == Kernel::exact && arguments.against->name == name)
    throw UsageError("--against " + name + ": an algorithm is not compared with itself");
}

/// Does a case by one of two algorithms, without the key that only the other one takes.
Json answer_beside(const Kernels& other, const Kernels& own, Algorithm algorithm,
                   const Json& object, Form form) {
  const bool has_others_way =
      !other.way.empty() && other.way != own.way && object.contains(other.way);
  if (!has_others_way) return algorithm(object, form);
  Json rest = object;
  rest.erase(std::string(other.way));
  return algorithm(rest, form);
}

/// The other algorithm's answer, over the exact kernel, next to the first answer.
class Comparison {
 public:
  Comparison(const ClipArguments& arguments, Algorithm algorithm, const Console& console)
      : arguments_(arguments),
        algorithm_(algorithm),
        console_(console),
        names_{arguments.algorithm.name, arguments.against->name} {
    if (arguments.kernel == Kernel::binary64) names_.first += " in binary64";
  }

  /// Answer of the first algorithm.
  [[nodiscard]] Json own_answer(const Json& object, Form form) const {
    return answer_beside(other(), arguments_.algorithm.kernels, algorithm_, object, form);
  }

  /// {"algorithm", "difference"}
  Json compare(const Json& object, std::size_t line) {
    constexpr Form exact{.exact = true};
    const Json own = own_answer(object, exact);
    const auto difference = clip::first_difference(own, others_answer(object, exact), names_);
    if (difference && !differs_)
      console_.note(cases::input_name(arguments_.file) + ": line " + std::to_string(line) + ": " +
                    clip::to_text(*difference, names_));
    differs_ = differs_ || difference;
    return {{"algorithm", names_.second}, {"difference", difference.value_or(nullptr)}};
  }
  [[nodiscard]] bool differs() const { return differs_; }

 private:
  [[nodiscard]] const Kernels& other() const { return arguments_.against->kernels; }

  [[nodiscard]] Json others_answer(const Json& object, Form form) const {
    try {
      return answer_beside(arguments_.algorithm.kernels, other(), other().exact, object, form);
    } catch (const InputError& error) {
      throw InputError("--against " + names_.second + ": " + error.what());
    }
  }

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
  cases::StepsPicture picture(arguments.draw);
  Form form = arguments.form;
  form.trace = form.trace || picture.is_wanted();
  const int status = cases::answer_lines(
      arguments.file, cases::AnswerLine([&](const Json& object, std::size_t line) {
        Json answer = comparison ? comparison->own_answer(object, form) : algorithm(object, form);
        if (picture.is_wanted())
          picture.add(drawing::draw_clip(arguments.algorithm.name, object, answer));
        if (!arguments.form.trace) answer.erase("trace");
        if (comparison) answer["against"] = comparison->compare(object, line);
        return answer;
      }));
  picture.finish("fathom clip --algorithm " + arguments.algorithm.name);
  return comparison && comparison->differs() ? answer_is_no : status;
}

}  // namespace

void add_clip(Command& program) {
  const auto arguments = std::make_shared<ClipArguments>();
  Command& command = program.command(
      "clip", description_of_companion("clip"),
      "  echo '{\"subject\":[[[0,0],[4,0],[4,4],[0,4]]],\"clip\":[[[2,1],[6,1],[2,3]]]}' |\n"
      "    fathom clip --algorithm weiler-atherton --exact\n"
      "  echo '{\"segment\": [[0,0],[9,6]], \"window\": [1,1,6,3]}' |\n"
      "    fathom clip --algorithm cohen-sutherland --trace\n"
      "  echo '{\"triangle\": [[1,0,0],[0,1,0],[0,0,1]], \"eye\": [2,2,2]}' |\n"
      "    fathom clip --algorithm plane\n"
      "  fathom clip --algorithm weiler-atherton --against cgal pairs.jsonl\n"
      "\nCases of weiler-atherton and cgal take \"op\": \"union\" or \"difference\"; the default "
      "is\n"
      "\"intersection\".");
  command
      .option("--algorithm", "NAME", into(arguments->algorithm, parse_named),
              "weiler-atherton, sutherland-hodgman, cohen-sutherland, liang-barsky, homogeneous, "
              "plane or cgal (CGAL's Boolean set operations)")
      .required();
  command.option("--against", "NAME", into(arguments->against, parse_named),
                 "Compare each answer with this algorithm's, exactly, and report the first "
                 "difference; exit status 1 if there is one");
  command.option("--kernel", "NAME", into(arguments->kernel, parse_kernel),
                 "Arithmetic: exact (default) or double");
  command.flag("--exact", arguments->form.exact, "Write numbers as \"p/q\"");
  command.flag("--trace", arguments->form.trace, "Add the steps that led to the answer");
  command.option("--draw", "SVG", into(arguments->draw, cases::parse_svg_name),
                 "Draw the steps: the segment after each split, the polygon after each edge or "
                 "plane, both lists and the walks");
  command.argument("FILE", arguments->file,
                   "File with one case per line (default and -: standard input)");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_clip(*arguments, console); });
}

}  // namespace fathom::app
