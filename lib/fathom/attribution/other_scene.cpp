#include "fathom/attribution/other_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers of pixels that show a surface in the map, in the scene, in either; with about the same
/// depth in both; and unexplained.
struct Surfaces {
  std::uint64_t in_map = 0, in_scene = 0, in_either = 0, agreeing = 0, unexplained = 0;
};

/// How near two depths have to be to count as about the same: a hundredth of the range from the
/// scene's nearest depth to its farthest. The depths of another scene that fell anywhere in that
/// range would do so at one pixel of fifty, so at nine tenths of the pixels only the same scene
/// does. A thousandth of the depth counts as well, for a wall that has no range.
class Agreement {
 public:
  explicit Agreement(const std::vector<double>& depths) {
    double least = infinity, greatest = -infinity;
    for (const double depth : depths) {
      if (!std::isfinite(depth)) continue;
      least = std::min(least, depth);
      greatest = std::max(greatest, depth);
    }
    if (least <= greatest) of_range_ = (greatest - least) / 100;
  }
  [[nodiscard]] bool holds(double truth, double other) const {
    return std::abs(other - truth) <= std::max(of_range_, std::abs(truth) / 1000);
  }

 private:
  double of_range_ = 0;
};

Surfaces surfaces_of(const Judgement& judged) {
  Surfaces s;
  const Agreement agreement(judged.truth->depths);
  for (std::size_t i = 0; i < judged.other.depths.size(); ++i) {
    const double truth = judged.truth->depths[i], other = judged.other.depths[i];
    const bool in_map = std::isfinite(other), in_scene = std::isfinite(truth);
    s.in_map += in_map;
    s.in_scene += in_scene;
    s.in_either += in_map || in_scene;
    s.agreeing += in_map && in_scene && agreement.holds(truth, other);
    s.unexplained += judged.attribution.classes[i] == PixelClass::unexplained;
  }
  return s;
}

bool has_named_fault(const Attribution& found) {
  return found.count(PixelClass::convention) > 0 ||
         std::any_of(found.findings.begin(), found.findings.end(),
                     [](const Finding& f) { return f.kind == "isolated-pixels"; });
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
  if (has_named_fault(judged.attribution) || s.unexplained * 10 < s.in_either * 9) return "";
  if (s.agreeing * 10 >= s.in_either * 9) return "";
  return "neither outlines nor depths fit: expected the SCENE and the camera that the map was "
         "drawn from, and its channel of depths";
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
