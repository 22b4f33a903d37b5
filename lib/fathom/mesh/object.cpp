#include "fathom/mesh/object.h"

#include <algorithm>

#include "fathom/numeric/dyadic.h"

namespace fathom {

std::uint64_t bytes_of(const WorldFromMesh& transform) {
  std::uint64_t limbs = 0;
  for (const auto& row : transform.rows)
    for (const Dyadic& number : row) limbs += mpz_size(number.significand());
  return limbs * sizeof(mp_limb_t);
}

std::uint64_t bytes_of(const Object& object) {
  return sizeof(Object) + object.name.size() + bytes_of(object.world_from_mesh);
}

std::optional<std::string> find_fault(const WorldFromMesh& transform) {
  long highest = -bit_of_zero, lowest = bit_of_zero;
  for (const auto& row : transform.rows) {
    for (const Dyadic& number : row) {
      if (number.is_zero()) continue;
      highest = std::max(highest, number.top());
      lowest = std::min(lowest, last_bit(number));
    }
  }
  if (highest > greatest_power_of_transform)
    return "is placed by a transform that reaches 2^" + std::to_string(highest - 1) +
           ", beyond 2^" + std::to_string(greatest_power_of_transform);
  if (highest - lowest > most_bits_of_transform)
    return "is placed by a transform of " + std::to_string(highest - lowest) + " bits, more than " +
           std::to_string(most_bits_of_transform);
  return std::nullopt;
}

}  // namespace fathom
