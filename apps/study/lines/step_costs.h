#pragma once

#include <cstdint>
#include <vector>

/// What a step of a line costs without the call that receives the pixel.
namespace fathom::studies {

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
