#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Algorithms that draw lines: how far they drift from the exact line, and what a step costs.
namespace fathom::studies {

/// What one algorithm did to lines of one length.
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
  const char* step;    ///< what is computed in each
  double nanoseconds;  ///< for a pixel of a long line, here, the least of five runs
};
std::vector<LineCost> line_costs();

/// (0,0)-(8,3) by an algorithm: the row of the pixel in each column, and what it decided by.
struct DecidedLine {
  std::string algorithm;
  std::vector<double> rows;
  std::string decisions;
};
std::vector<DecidedLine> decided_lines();

// What a step of a line costs without the call that receives the pixel.

/// Nanoseconds a pixel of a long line, here, the least of several runs. Coordinates are rounded by
/// truncation of y + ½, the cheapest way, so that little else than the arithmetic is measured.
struct StepCost {
  const char* step;
  double binary32_ns, binary64_ns;
};

/// The explicit equation, whose products do not wait for each other; DDA, where each sum waits for
/// the one before; and four DDAs in turns, a quarter of the line each, whose sums wait for those
/// four steps before: the same additions.
std::vector<StepCost> step_costs();

/// The sum of the rows of all pixels, which each of them computes: m from 0 to 1, row 0 at first.
/// `steps` is a multiple of 4.
template <class Number>
std::int64_t rows_by_products(std::int64_t steps, Number m);
template <class Number>
std::int64_t rows_by_sums(std::int64_t steps, Number m);
template <class Number>
std::int64_t rows_by_four_sums(std::int64_t steps, Number m);

}  // namespace fathom::studies
