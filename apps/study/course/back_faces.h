#pragma once

#include <cstdint>
#include <vector>

#include "apps/study/scene_files.h"

/// Which side of a triangle is seen.
namespace fathom::studies {

/// How many triangles of a closed ball face the eye by each of the three tests.
struct FacingCount {
  double distance = 0;  ///< of the eye from the middle, in radii
  pipeline::Precision precision{};
  std::uint64_t triangles = 0, front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t disagreeing = 0;  ///< triangles on which the three tests disagree
  /// What is seen of a ball of radius 1 from there: (1 − 1/distance)/2 of its surface.
  double seen_share = 0;
};
std::vector<FacingCount> count_facings();

/// Triangles whose third corner lies in the plane through the eye and the other two, but for its
/// rounding to binary32: edge-on.obj and edge-on.json. The eye is the origin; all corners are
/// numbers of binary32.
SceneFiles edge_on_files();

/// What the three tests say of each of these triangles. A test is wrong where it does not say what
/// the sign of the determinant of the three corners says, which is computed in integers.
struct EdgeOnCount {
  pipeline::Precision precision{};
  std::uint64_t triangles = 0, front = 0;  ///< by the exact sign
  std::uint64_t front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t wrong_in_world = 0, wrong_in_ndc = 0, wrong_in_window = 0;
  std::uint64_t disagreeing = 0;
  /// Triangles that are drawn the other way round than the window's test says, or not at all.
  std::uint64_t turned_by_snapping = 0;
};
std::vector<EdgeOnCount> count_edge_on();

/// A box without its lid from above, by the rule of what is front and the side that is culled.
SceneFiles open_box_files();
RgbImage open_box(pipeline::FrontFace front_face, pipeline::Culling culling);

}  // namespace fathom::studies
