#include "fathom/attribution/pixels/corner_numbers.h"

#include <array>
#include <cstring>
#include <unordered_map>

namespace fathom::attribution {
namespace {

struct PositionHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) {
      std::uint64_t bits = 0;
      const double value = x == 0 ? 0 : x;  // −0 is 0
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

}  // namespace

std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, PositionHash> first;
  std::vector<std::uint32_t> numbers(mesh.points.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = first.emplace(mesh.points[i], i).first->second;
  }
  return numbers;
}

}  // namespace fathom::attribution
