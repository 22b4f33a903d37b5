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

}  // namespace fathom::studies
