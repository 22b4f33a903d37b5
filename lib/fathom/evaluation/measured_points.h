#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fathom {

/// A point of a surface and how far it is from the other one; scene units.
struct MeasuredPoint {
  /// Each coordinate in the world is the exact one rounded once, as the distance is.
  std::array<double, 3> at{};
  double distance = 0;
};

/// The points as a PLY file, binary little endian: x y z and the distance as `quality`, the name
/// that MeshLab and CloudCompare know, all double.
std::vector<std::byte> ply_of(const std::vector<MeasuredPoint>& points);

}  // namespace fathom
