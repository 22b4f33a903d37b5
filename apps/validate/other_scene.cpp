#include "apps/validate/other_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace fathom::app {
namespace {

using attribution::PixelClass;
using validation::ValidationCase;

/// Pixels that show a surface: in the map, in the scene, in either, and those that stay unexplained.
struct Surfaces {
  std::uint64_t in_map = 0, in_scene = 0, in_either = 0, unexplained = 0;
};

Surfaces surfaces_of(const ValidationCase& c) {
  Surfaces s;
  for (std::size_t i = 0; i < c.other.depths.size(); ++i) {
    const bool in_map = std::isfinite(c.other.depths[i]);
    const bool in_scene = std::isfinite(c.truth->depths[i]);
    s.in_map += in_map;
    s.in_scene += in_scene;
    s.in_either += in_map || in_scene;
    s.unexplained += c.attribution.classes[i] == PixelClass::unexplained;
  }
  return s;
}

std::string what_does_not_fit(const ValidationCase& c) {
  const Surfaces s = surfaces_of(c);
  if (s.in_either == 0 || s.unexplained == 0) return "";
  if (s.in_map == 0) {
    return "the map shows no surface at all: expected depths that are finite and above 0";
  }
  if (s.in_scene == 0) {
    return "SCENE is out of the camera's sight: expected the camera that the map was drawn with";
  }
  const bool has_named_fault = c.attribution.count(PixelClass::convention) > 0;
  if (has_named_fault || s.unexplained * 10 < s.in_either * 9) return "";
  return "neither outlines nor depths fit: expected the SCENE and the camera that the map was "
         "drawn "
         "from, and its channel of depths";
}

}  // namespace

void name_other_scene(ValidationCase& c) {
  const std::string text = what_does_not_fit(c);
  if (text.empty()) return;
  c.attribution.findings = {{"other-scene", text, c.attribution.count(PixelClass::unexplained)}};
}

}  // namespace fathom::app
