#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "validation/scenes/validation_scenes.h"

/// Faults as code: what goes wrong with depth maps, to see whether it is found and rightly named.
namespace fathom::validation {

/// A right map as a renderer drew it, and the exact map.
struct RightMap {
  const attribution::Truth& truth;
  /// Only depths, in binary32, infinite in the background.
  const attribution::OtherMap& map;
};

/// One fault: either a renderer is made to draw something else, or its map is changed afterwards.
struct Fault {
  /// background, storage, units, decoding, camera, image, surfaces or pixels.
  std::string group;
  std::string name;
  /// Correct names: kinds of findings or notes.
  std::vector<std::string> kinds;
  /// Draws another scene than declared, or with another camera.
  std::function<ValidationScene(const ValidationScene& scene, double size)> drawn;
  /// What becomes of a right map: `values` and `depths` of `map` are changed.
  std::function<void(attribution::OtherMap& map, const RightMap& right, double size)> changed;
  /// A small size to start from; 0 for a fault that has no size.
  double probe = 0;
  /// Unit of the size: "pixels", "rad", …
  std::string unit;
  /// Only of a rasterizer, whose depths are decoded from window depths.
  bool raster_only = false;

  [[nodiscard]] bool has_size() const { return probe > 0; }
};

/// All of them, by groups.
std::vector<Fault> fault_catalogue();

}  // namespace fathom::validation
