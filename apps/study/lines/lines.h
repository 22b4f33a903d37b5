#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Algorithms that draw lines: their drift from the exact line, and the cost of a step.
namespace fathom::studies {

/// Results of an algorithm for lines of one length.
struct LineDrift {
  std::string algorithm;
  std::int64_t length = 0;
  std::uint64_t pixels = 0, wrong = 0, wrong_at_ties = 0;
  double greatest = 0;  ///< of the minor coordinate before rounding, in pixels

  [[nodiscard]] double percent_wrong() const {
    return 100.0 * static_cast<double>(wrong) / static_cast<double>(pixels);
  }
};
/// Lines of random slopes, by every algorithm that rounds.
std::vector<LineDrift> measure_drift(std::int64_t length, std::uint32_t slopes);

struct LineCost {
  const char* algorithm;
  const char* step;    ///< the computation in each step
  double nanoseconds;  ///< for a pixel of a long line on this machine, the least of five runs
};
std::vector<LineCost> line_costs();

/// The line (0,0)-(8,3) by an algorithm: the row of the pixel in each column, and the values that
/// decided it.
struct DecidedLine {
  std::string algorithm;
  std::vector<double> rows;
  std::string decisions;
};
std::vector<DecidedLine> decided_lines();

// The cost of a step of a line, without the call that receives the pixel.

/// Nanoseconds per pixel of a long line on this machine, the least of several runs. Coordinates are
/// rounded by truncation of y + ½, the cheapest way, so that almost only the arithmetic is
/// measured.
struct StepCost {
  const char* step;
  double binary32_ns, binary64_ns;
};

/// The explicit equation, whose products do not wait for each other; DDA, where each sum waits for
/// the previous sum; and four DDAs in turns, each for a quarter of the line, where each sum waits
/// for the sum four steps earlier: the same additions.
std::vector<StepCost> step_costs();

/// The sum of the rows of all pixels, the result of each algorithm: m from 0 to 1, beginning in row
/// 0. `steps` is a multiple of 4.
template <class Number>
std::int64_t rows_by_products(std::int64_t steps, Number m);
template <class Number>
std::int64_t rows_by_sums(std::int64_t steps, Number m);
template <class Number>
std::int64_t rows_by_four_sums(std::int64_t steps, Number m);

}  // namespace fathom::studies
