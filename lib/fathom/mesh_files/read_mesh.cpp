#include "fathom/mesh_files/read_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace fathom::mesh_files {
namespace {

template <class Value>
bool is_finite(const Value& value) {
  return std::all_of(value.begin(), value.end(), [](auto x) { return std::isfinite(x); });
}

bool is_zero(const std::array<double, 3>& value) {
  return std::all_of(value.begin(), value.end(), [](double x) { return x == 0; });
}

/// How many are not finite. What `corners` names of these and of those that mean nothing, or else
/// the triangles by their vertices, is none.
template <class Value, class MeansNothing>
std::size_t leave_out(std::vector<Value>& values, MeshArray<CornerIndices>& corners,
                      const MeshArray<CornerIndices>& triangles, MeansNothing means_nothing) {
  std::vector<bool> odd(values.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool finite = is_finite(values[i]);
    if (finite && !means_nothing(values[i])) continue;
    odd[i] = true;
    values[i] = {};
    count += !finite;
  }
  if (std::find(odd.begin(), odd.end(), true) == odd.end()) return 0;
  if (corners.empty()) corners = triangles;
  for (CornerIndices& corner : corners)
    for (std::uint32_t& index : corner)
      if (index < odd.size() && odd[index]) index = no_index;
  return count;
}

}  // namespace

void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings) {
  std::size_t count = leave_out(mesh.normals, mesh.normal_triangles, mesh.triangles, is_zero) +
                      leave_out(mesh.texture_coordinates, mesh.texture_triangles, mesh.triangles,
                                [](const auto&) { return false; });
  for (auto& colour : mesh.colours) {
    if (is_finite(colour)) continue;
    colour = {1, 1, 1, 1};
    ++count;
  }
  if (count > 0)
    warnings.push_back(file + ": " + std::to_string(count) +
                       " normals, texture coordinates or colours are not finite numbers; they are "
                       "left out");
}

}  // namespace fathom::mesh_files
