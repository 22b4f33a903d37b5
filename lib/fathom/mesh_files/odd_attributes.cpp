#include "fathom/mesh_files/odd_attributes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fathom::mesh_files {
namespace {

template <class Value>
bool is_finite(const Value& value) {
  return std::all_of(value.begin(), value.end(), [](auto x) { return std::isfinite(x); });
}

/// How many there are. What `corners` names, or else the triangles by their vertices, is none.
template <class Value>
std::size_t leave_out(std::vector<Value>& values, std::vector<CornerIndices>& corners,
                      const std::vector<CornerIndices>& triangles) {
  std::vector<bool> odd(values.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_finite(values[i])) continue;
    odd[i] = true;
    values[i] = {};
    ++count;
  }
  if (count == 0) return 0;
  if (corners.empty()) corners = triangles;
  for (CornerIndices& corner : corners)
    for (std::uint32_t& index : corner)
      if (index < odd.size() && odd[index]) index = no_index;
  return count;
}

}  // namespace

void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings) {
  std::size_t count = leave_out(mesh.normals, mesh.normal_triangles, mesh.triangles) +
                      leave_out(mesh.texture_coordinates, mesh.texture_triangles, mesh.triangles);
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
