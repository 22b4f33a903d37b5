#pragma once

#include <cstddef>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/rays/ray.h"
#include "validation/blender/blender_panorama.h"
#include "validation/lenses/lens_cases.h"
#include "validation/rays/ray_engines.h"

/// Why a ray tracer's map of a lens differs from the exact map.
namespace fathom::validation {

/// Blender's Cycles among the names of engines, which are otherwise those of ray_engines.h.
inline constexpr const char* cycles_engine = "cycles";

struct JudgedLens {
  /// Pixels that have a ray.
  std::size_t rays = 0;
  attribution::OtherMap map;
  /// Does not search for faults of the whole image.
  attribution::Attribution attribution;
  /// Explained pixels that show another triangle than the exact map, or nothing, because exact
  /// arithmetic finds the same on the rounded ray: the rounding of the direction is the reason.
  /// The other pixels of these classes differ by the engine's own arithmetic.
  std::size_t by_rounded_rays = 0;
  /// Missed surfaces that exact arithmetic finds on the rounded ray.
  std::size_t missed = 0;
  /// Explained pixels of Cycles that no azimuth without the steps of acosf explains.
  std::size_t by_acos = 0;

  [[nodiscard]] std::size_t unexplained() const {
    return attribution.count(attribution::PixelClass::unexplained);
  }
};

/// Judges the answers of engines that are given the rays of a case.
class LensJudge {
 public:
  /// `given` has to outlive it.
  explicit LensJudge(const LensCase& given);

  [[nodiscard]] const RoundedRays& rays() const { return rays_; }

  /// `answers`: of rays().
  /// Exact    each ray is known bit by bit; only the engine's own arithmetic has a bound
  ///          (docs/validation.md, "A ray tracer").
  [[nodiscard]] JudgedLens judge(const EngineAnswers& answers) const;

 private:
  const LensCase& given_;
  RoundedRays rays_;
  /// The exact answers to the rounded rays.
  std::vector<RayHit> hits_;
  attribution::RendererModel model_;
};

/// Judges a map that Cycles drew of scene_for_blender(), by the bounds of cycles_rays().
/// Needs    a case of one of blender_panoramas().
JudgedLens judge_cycles(const LensCase& given, attribution::OtherMap map);

}  // namespace fathom::validation
