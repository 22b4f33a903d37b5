#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/oracle/areas.h"

/// The slow answer to which edges are visible, in GMP's rational numbers: every line along which
/// something may change is cut at every other, and at the middle of each piece all triangles are
/// compared, on both sides. No parts, sheets or sweeps.
namespace fathom::checks {

/// A piece of a line with different visible triangles on its sides, or nothing on one.
struct JudgedEdge {
  oracle::Point from, to;
  /// As VisibleEdge has them.
  std::uint32_t owner = 0;
  std::optional<std::uint32_t> other;
  bool joined = false;
};

/// An image with its camera, and triangles with their objects.
struct JudgedScene {
  oracle::RayCamera camera;
  std::uint32_t width, height;
  std::vector<oracle::Triangle> triangles;
  std::vector<std::uint32_t> objects;
};

std::vector<JudgedEdge> judged_edges(const JudgedScene& scene);

}  // namespace fathom::checks
