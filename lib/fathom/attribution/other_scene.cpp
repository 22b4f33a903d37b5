#include "fathom/attribution/other_scene.h"

#include <cmath>
#include <string>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

/// Pixels that show a surface: in the map, in the scene, in either, and those that stay unexplained.
struct Surfaces {
  std::uint64_t in_map = 0, in_scene = 0, in_either = 0, unexplained = 0;
};

Surfaces surfaces_of(const Judgement& judged) {
  Surfaces s;
  for (std::size_t i = 0; i < judged.other.depths.size(); ++i) {
    const bool in_map = std::isfinite(judged.other.depths[i]);
    const bool in_scene = std::isfinite(judged.truth->depths[i]);
    s.in_map += in_map;
    s.in_scene += in_scene;
    s.in_either += in_map || in_scene;
    s.unexplained += judged.attribution.classes[i] == PixelClass::unexplained;
  }
  return s;
}

std::string what_does_not_fit(const Judgement& judged) {
  const Surfaces s = surfaces_of(judged);
  if (s.in_either == 0 || s.unexplained == 0) return "";
  if (s.in_map == 0) {
    return "the map shows no surface at all: expected depths that are finite and above 0";
  }
  if (s.in_scene == 0) {
    return "SCENE is out of the camera's sight: expected the camera that the map was drawn with";
  }
  const bool has_named_fault = judged.attribution.count(PixelClass::convention) > 0;
  if (has_named_fault || s.unexplained * 10 < s.in_either * 9) return "";
  return "neither outlines nor depths fit: expected the SCENE and the camera that the map was "
         "drawn from, "
         " and its channel of depths";
}

}  // namespace

void name_other_scene(Judgement& judged) {
  const StandardArithmetic standard;
  const std::string text = what_does_not_fit(judged);
  if (text.empty()) return;
  judged.attribution.findings = {
      {"other-scene", text, judged.attribution.count(PixelClass::unexplained)}};
}

}  // namespace fathom::attribution
