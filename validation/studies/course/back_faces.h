#pragma once

#include <cstdint>
#include <vector>

#include "validation/studies/scene_files.h"

/// Which side of a triangle is seen.
namespace fathom::studies {

/// How many triangles of a closed ball face the eye by each of the three tests.
struct FacingCount {
  double distance = 0;  ///< of the eye from the middle, in radii
  pipeline::Precision precision{};
  std::uint64_t triangles = 0, front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t disagreeing = 0;  ///< triangles about which the tests are not of one mind
  /// What is seen of a ball of radius 1 from there: (1 − 1/distance)/2 of its surface.
  double seen_share = 0;
};
std::vector<FacingCount> count_facings();

/// A box without its lid from above, by the rule of what is front and the side that is culled.
SceneFiles open_box_files();
RgbImage open_box(pipeline::FrontFace front_face, pipeline::Culling culling);

}  // namespace fathom::studies
