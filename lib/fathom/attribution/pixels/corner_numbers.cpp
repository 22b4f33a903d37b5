#include "fathom/attribution/pixels/corner_numbers.h"

#include <array>
#include <cstring>
#include <unordered_map>
#include <vector>

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

using Points = std::vector<std::array<double, 3>>;

void append_numbers(const Points& points, std::vector<std::uint32_t>& numbers) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, PositionHash> first;
  for (const auto& point : points) {
    numbers.push_back(first.emplace(point, numbers.size()).first->second);
  }
}

}  // namespace

std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(mesh.points.size());
  append_numbers(mesh.points, numbers);
  return numbers;
}

std::vector<std::uint32_t> corner_numbers(const std::vector<RasterPart>& parts) {
  std::vector<std::uint32_t> numbers;
  for (const RasterPart& part : parts) append_numbers(*part.points, numbers);
  return numbers;
}

}  // namespace fathom::attribution
