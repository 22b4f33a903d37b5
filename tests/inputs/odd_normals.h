#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "fathom/mesh/mesh.h"

namespace fathom::checks {

/// Normals as odd as they come: none, zeros, equal ones, opposite ones, of any magnitude.
inline void add_odd_normals(Mesh& mesh, std::mt19937_64& random) {
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  const auto component = [&] {
    switch (below(6)) {
      case 0:
        return 0.0;
      case 1:
        return std::ldexp(static_cast<double>(random() >> 11), -53) - 0.5;
      default:
        return (below(9) - 4) / 4.0;
    }
  };
  const int size = below(5) == 0 ? 1 : 0;
  const double scales[] = {1e300, 1e-300, 1e-310, 1e150, 1e-13};
  for (int i = 0; i < 9; ++i) {
    const double scale = size != 0 || below(8) == 0 ? scales[below(5)] : 1;
    mesh.normals.push_back({component() * scale, component() * scale, component() * scale});
  }
  mesh.normals.push_back({0, 0, 0});
  mesh.normals.push_back({-mesh.normals[0][0], -mesh.normals[0][1], -mesh.normals[0][2]});
  const bool some_lack = below(3) == 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    CornerIndices corners{};
    for (std::uint32_t& n : corners) {
      n = some_lack && below(4) == 0 ? no_index : static_cast<std::uint32_t>(below(11));
    }
    if (below(4) == 0) corners[1] = corners[2] = corners[0];
    mesh.normal_triangles.push_back(corners);
  }
}

}  // namespace fathom::checks
