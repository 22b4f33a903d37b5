#include "fathom/mesh_files/expansion_budget.h"

#include <limits>

#include "fathom/failures/errors.h"

namespace fathom::mesh_files {
namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

// Sums and products that stay at the largest number instead of beginning again at 0.
std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
  return b > most - a ? most : a + b;
}
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > most / b ? most : a * b;
}

}  // namespace

void ExpansionBudget::add_input(std::uint64_t bytes) {
  input_ = plus(input_, bytes);
}

std::uint64_t ExpansionBudget::allowed() const {
  return plus(free_bytes, times(factor_, input_));
}

void ExpansionBudget::take(std::uint64_t count, std::uint64_t size) {
  const std::uint64_t total = plus(taken_, times(count, size));
  if (total > allowed())
    throw InputError(file_ + ": its " + std::to_string(input_) + " bytes would take more than " +
                     std::to_string(allowed()) + " bytes of memory, " + std::to_string(factor_) +
                     " times as many and 64 MiB; a greater --max-expansion allows it");
  taken_ = total;
}

void ExpansionBudget::take_object(std::uint64_t bytes, std::uint64_t triangles) {
  take(1, bytes);
  take(triangles, bytes_of_placed_triangle);
}

}  // namespace fathom::mesh_files
