#include <algorithm>
#include <chrono>
#include <limits>

#include "apps/study/lines/lines.h"

namespace fathom::studies {
namespace {

constexpr std::int64_t steps = 1000000;

/// Rounded to the nearest row; y is not negative.
template <class Number>
std::int64_t row_of(Number y) {
  return static_cast<std::int64_t>(y + Number(0.5));
}

template <class Number>
double nanoseconds(std::int64_t (*rows)(std::int64_t, Number)) {
  // Not known to the compiler, so that nothing is computed beforehand.
  static volatile double slope = 0.333333;
  [[maybe_unused]] static volatile std::int64_t kept;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 15; ++run) {
    const auto start = std::chrono::steady_clock::now();
    kept = rows(steps, static_cast<Number>(slope));
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    least = std::min(least, time.count() / steps);
  }
  return least;
}

}  // namespace

template <class Number>
std::int64_t rows_by_products(std::int64_t count, Number m) {
  std::int64_t sum = 0;
  for (std::int64_t i = 0; i < count; ++i) sum += row_of(m * static_cast<Number>(i));
  return sum;
}

template <class Number>
std::int64_t rows_by_sums(std::int64_t count, Number m) {
  std::int64_t sum = 0;
  Number y = 0;
  for (std::int64_t i = 0; i < count; ++i, y += m) sum += row_of(y);
  return sum;
}

template <class Number>
std::int64_t rows_by_four_sums(std::int64_t count, Number m) {
  const std::int64_t quarter = count / 4;
  const auto start = [&](std::int64_t k) { return m * static_cast<Number>(k * quarter); };
  Number a = 0, b = start(1), c = start(2), d = start(3);
  std::int64_t sum = 0;
  for (std::int64_t i = 0; i < quarter; ++i) {
    sum += row_of(a) + row_of(b) + row_of(c) + row_of(d);
    a += m, b += m, c += m, d += m;
  }
  return sum;
}

std::vector<StepCost> step_costs() {
  return {{"explicit: a product", nanoseconds(rows_by_products<float>),
           nanoseconds(rows_by_products<double>)},
          {"DDA: a sum, which waits for the one before", nanoseconds(rows_by_sums<float>),
           nanoseconds(rows_by_sums<double>)},
          {"four DDAs in turns: the same sums, which wait for those four steps before",
           nanoseconds(rows_by_four_sums<float>), nanoseconds(rows_by_four_sums<double>)}};
}

template std::int64_t rows_by_products(std::int64_t, float);
template std::int64_t rows_by_products(std::int64_t, double);
template std::int64_t rows_by_sums(std::int64_t, float);
template std::int64_t rows_by_sums(std::int64_t, double);
template std::int64_t rows_by_four_sums(std::int64_t, float);
template std::int64_t rows_by_four_sums(std::int64_t, double);

}  // namespace fathom::studies
