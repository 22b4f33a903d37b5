#include "apps/textbook/scan/scan_cases.h"

#include <fmt/format.h>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"

namespace fathom::app::scan {
namespace {

using pipeline::Exact;

constexpr Answers drawing_pixels{.pixels = true, .steps = true};
constexpr Answers stepping{.pixels = true, .steps = true, .ties = true};
constexpr Answers filling_triangles{.pixels = true, .steps = true, .triangles = true};
constexpr Answers half_planes{.pixels = true, .steps = true, .triangles = true, .edges = true};
constexpr Answers filling{.pixels = true};
constexpr Answers valuing{.triangles = true, .values = true};
constexpr Answers question{};

// Templates cannot be put in parentheses.
// NOLINTNEXTLINE(bugprone-macro-parentheses)
#define FATHOM_SCAN(name) name<Exact>, name<double>, name<float>
const std::vector<NamedAlgorithm>& algorithms() {
  static const std::vector<NamedAlgorithm> all{
      {"explicit", FATHOM_SCAN(explicit_line), stepping},
      {"dda", FATHOM_SCAN(dda), stepping},
      {"bresenham", FATHOM_SCAN(bresenham), stepping},
      {"midpoint", FATHOM_SCAN(midpoint), stepping},
      {"diamond-exit", FATHOM_SCAN(diamond_exit), drawing_pixels},
      {"line-forms", FATHOM_SCAN(line_forms), question},
      {"even-odd", FATHOM_SCAN(even_odd), drawing_pixels},
      {"non-zero", FATHOM_SCAN(non_zero), drawing_pixels},
      {"flood", flood, flood, flood, filling},
      {"edge-function", FATHOM_SCAN(edge_function), half_planes},
      {"scan-line", FATHOM_SCAN(scan_line), filling_triangles},
      {"edge-values", FATHOM_SCAN(edge_values), valuing},
      {"inside", FATHOM_SCAN(inside), question},
      {"convexity", FATHOM_SCAN(convexity), question},
      {"tessellate", tessellate, tessellate, tessellate, question},
      {"convex-hull", FATHOM_SCAN(convex_hull), question}};
  return all;
}
#undef FATHOM_SCAN

}  // namespace

NamedAlgorithm parse_algorithm(const std::string& text) {
  for (const NamedAlgorithm& algorithm : algorithms())
    if (algorithm.name == text) return algorithm;
  refuse_word(text, algorithm_names());
}

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names;
  for (const NamedAlgorithm& algorithm : algorithms()) names.push_back(algorithm.name);
  return names;
}

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

void require_effect(const NamedAlgorithm& algorithm, const Form& form, bool draw) {
  const auto& [name, exact, float64, float32, answers] = algorithm;
  if (form.subpixel_bits && !answers.triangles)
    throw UsageError("--subpixel-bits is for triangles: edge-function and scan-line");
  if (form.ties && !answers.ties)
    throw UsageError("--ties is for lines: explicit, dda, bresenham and midpoint");
  if (form.edges && !answers.edges) throw UsageError("--edges is for edge-function");
  if (form.runs && !answers.pixels)
    throw UsageError(fmt::format("--runs: {} draws no pixels; leave the option out", name));
  if (form.numbers.trace && !answers.steps)
    throw UsageError(fmt::format("--trace: {} shows no steps; leave the option out", name));
  if (draw && !answers.drawable())
    throw UsageError(fmt::format("--draw: {} shows no steps; leave the option out", name));
  if (draw && form.runs) throw UsageError("--draw shows pixels; leave --runs out");
}

Algorithm in_arithmetic(const NamedAlgorithm& algorithm, Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::float64:
      return algorithm.float64;
    case Arithmetic::float32:
      return algorithm.float32;
    default:
      return algorithm.exact;
  }
}

}  // namespace fathom::app::scan
