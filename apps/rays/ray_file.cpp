#include "apps/rays/ray_file.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "apps/rays/number_rows.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/npy_array.h"

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

RayFile::RayFile(const std::string& file) : rows_(file, {"ray", ray_columns, fault_of_ray}) {}

std::vector<Ray> RayFile::next(std::size_t most) {
  std::vector<Ray> rays;
  NumberRow row;
  while (rays.size() < most && rows_.next(row)) rays.push_back(ray_of(row));
  return rays;
}

std::vector<Ray> read_rays(const std::string& file) {
  return RayFile(file).next(SIZE_MAX);
}

files::Bytes npy_of_rays(std::span<const Ray> rays) {
  constexpr std::size_t row = sizeof(double) * NumberRow{}.size();
  files::Bytes bytes = image::npy_header("<f8", std::to_string(rays.size()) + ", 6");
  std::size_t end = bytes.size();
  bytes.resize(end + rays.size() * row);
  for (const Ray& ray : rays)
    for (const auto& numbers : {ray.origin, ray.direction})
      for (const double x : numbers) {
        store(&bytes[end], x, std::endian::little);
        end += sizeof x;
      }
  return bytes;
}

SightPairs read_pairs(const std::string& file) {
  NumberRows rows(file, {"pair", pair_columns, fault_of_pair});
  SightPairs pairs;
  NumberRow row;
  while (rows.next(row)) {
    pairs.eyes.emplace_back(std::array{row[0], row[1], row[2]});
    if (rows.names() == on_surface) {
      pairs.points.emplace_back(SurfacePoint{static_cast<std::uint32_t>(row[3]), row[4], row[5]});
    } else {
      pairs.points.emplace_back(std::array{row[3], row[4], row[5]});
    }
  }
  return pairs;
}

}  // namespace fathom::app
