#pragma once

#include <string>
#include <vector>

#include "apps/textbook/scan/scan_algorithms.h"

/// The algorithms of `fathom scan` by name, and what each takes: for the command and for Python.
namespace fathom::app::scan {

using Algorithm = Json (*)(const Json&, const Form&);

/// What an algorithm's answer has, and so which options it takes.
struct Answers {
  bool pixels = false;     ///< --runs
  bool steps = false;      ///< --trace
  bool triangles = false;  ///< --subpixel-bits
  bool ties = false;       ///< --ties
  bool edges = false;      ///< --edges
  bool values = false;     ///< --values

  /// Whether --draw has something to show.
  [[nodiscard]] bool drawable() const { return steps || values; }
};

/// An algorithm over each arithmetic.
struct NamedAlgorithm {
  std::string name;
  Algorithm exact = nullptr, float64 = nullptr, float32 = nullptr;
  Answers answers;
};

enum class Arithmetic { exact, float64, float32 };

/// Fail     UsageError, naming the words that exist.
NamedAlgorithm parse_algorithm(const std::string& text);
Arithmetic parse_arithmetic(const std::string& text);
int parse_subpixel_bits(const std::string& text);
pipeline::TieRule parse_ties(const std::string& text);
pipeline::EdgeRule parse_edges(const std::string& text);
std::vector<std::string> algorithm_names();

/// Refuses options that would change nothing.
/// Fails    UsageError "--runs: …".
void require_effect(const NamedAlgorithm& algorithm, const Form& form, bool draw);

Algorithm in_arithmetic(const NamedAlgorithm& algorithm, Arithmetic arithmetic);

/// {"triangle", "width", "height"}: the three edge functions at the centre of every pixel of the
/// image, outside the triangle too; the inside of every edge is positive, as for edge-function.
/// Answer   {"edges": [{"edge", "a", "b", "c"}], "values": [[[e_BC, e_CA, e_AB], …], …]}, row by
///          row; both empty if the triangle has no area.
template <class Number>
Json edge_values(const Json& object, const Form& form);

/// The values of an answer as a file: CSV (x,y,BC,CA,AB, a pixel a line), or NPY of shape (height,
/// width, 3) in binary64.
/// Fails    InputError for NPY of a triangle without area.
enum class ValuesFormat { csv, npy };
std::string values_file(const Json& answer, ValuesFormat format);

}  // namespace fathom::app::scan
