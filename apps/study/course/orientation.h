#pragma once

#include <cstdint>
#include <vector>

#include "apps/study/pipeline_scenes.h"

/// Which side of a triangle faces the eye.
namespace fathom::studies {

/// How many triangles of a closed ball face the eye by each of the three tests.
struct FacingCount {
  double distance = 0;  ///< of the eye from the middle, in radii
  pipeline::Precision precision{};
  std::uint64_t triangles = 0, front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t disagreeing = 0;  ///< triangles on which the three tests disagree
  /// The visible share of the surface of a ball of radius 1: (1 − 1/distance)/2.
  double seen_share = 0;
};
std::vector<FacingCount> count_facings();

/// Triangles whose third corner lies in the plane through the eye and the other two corners, except
/// for its rounding to binary32: edge-on.obj and edge-on.json. The eye is the origin; all corners
/// are binary32 numbers.
SceneFiles edge_on_files();

/// Results of the three tests for these triangles. A test is wrong if it differs from the sign of
/// the determinant of the three corners, which is computed in integers.
struct EdgeOnCount {
  pipeline::Precision precision{};
  std::uint64_t triangles = 0, front = 0;  ///< by the exact sign
  std::uint64_t front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t wrong_in_world = 0, wrong_in_ndc = 0, wrong_in_window = 0;
  std::uint64_t disagreeing = 0;
  /// Triangles that are drawn with another orientation than by the window's test, or not at all.
  std::uint64_t turned_by_snapping = 0;
};
std::vector<EdgeOnCount> count_edge_on();

/// A box without its lid from above, drawn with this rule of front faces and this culling.
SceneFiles open_box_files();
RgbImage open_box(pipeline::FrontFace front_face, pipeline::Culling culling);

}  // namespace fathom::studies
