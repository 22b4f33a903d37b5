#include "apps/rays/ray_file.h"

#include <array>
#include <cstdint>

#include "apps/rays/number_rows.h"

namespace fathom::app {
namespace {

constexpr std::array<ColumnNames, 1> ray_columns{{{"x", "y", "z", "dx", "dy", "dz"}}};
constexpr std::array<ColumnNames, 2> pair_columns{
    {{"x", "y", "z", "px", "py", "pz"}, {"x", "y", "z", "triangle", "v", "w"}}};
/// The number of the second set.
constexpr std::size_t on_surface = 1;

Ray ray_of(const NumberRow& n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

std::string fault_of_ray(std::size_t, const NumberRow& row) {
  return ray_of(row).direction == std::array<double, 3>{} ? "the direction is 0" : "";
}

bool is_triangle_number(double x) {
  return x >= 0 && x < no_triangle && x == static_cast<double>(static_cast<std::uint32_t>(x));
}

std::string fault_of_pair(std::size_t names, const NumberRow& row) {
  if (names != on_surface || is_triangle_number(row[3])) return "";
  return "expected the number of a triangle";
}

}  // namespace

std::vector<Ray> read_rays(const std::string& file) {
  std::vector<Ray> rays;
  for (const NumberRow& row : read_rows(file, "ray", ray_columns, fault_of_ray).rows)
    rays.push_back(ray_of(row));
  return rays;
}

SightPairs read_pairs(const std::string& file) {
  const NumberRows given = read_rows(file, "pair", pair_columns, fault_of_pair);
  SightPairs pairs;
  for (const NumberRow& row : given.rows) {
    pairs.eyes.emplace_back(std::array{row[0], row[1], row[2]});
    if (given.names == on_surface) {
      pairs.points.emplace_back(SurfacePoint{static_cast<std::uint32_t>(row[3]), row[4], row[5]});
    } else {
      pairs.points.emplace_back(std::array{row[3], row[4], row[5]});
    }
  }
  return pairs;
}

}  // namespace fathom::app
