#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fathom/rays/ray.h"
#include "validation/rays/ray_cases.h"
#include "validation/rays/ray_engines.h"

/// How an engine's answers to rays differ from the truth.
namespace fathom::validation {

/// - right: the triangle of the specification, or correctly no hit
/// - tie: another correct answer: the ray touches an edge or a corner, and the answer is the hit of
///   a neighbouring ray, or another triangle that the ray touches at the same place
/// - lost: no hit, although the ray meets a triangle
/// - invented: a hit, although the ray meets no triangle
/// - behind: a triangle behind the nearest triangle, through which the ray has passed
/// - beside: a triangle that the ray does not touch, such as the neighbour across an edge, although
///   it meets another one
enum class RayVerdict { right, tie, lost, invented, behind, beside };
inline constexpr std::size_t verdict_count = 6;

const char* name_of(RayVerdict verdict);
/// Whether an answer is wrong.
bool is_fault(RayVerdict verdict);

struct JudgedRays {
  /// Of each ray.
  std::vector<RayHit> truth;
  std::vector<RayVerdict> verdicts;
  std::array<std::size_t, verdict_count> counts{};
  /// Numbers of rays that touch no edge or corner and for which the engine counts too few or too
  /// many hits. Rays that touch edges or corners are not judged, because engines may count these
  /// hits in any way.
  std::size_t counts_too_low = 0, counts_too_high = 0, counts_judged = 0;
  /// The greatest error of t, among right answers, in steps of binary32 at the true t.
  double greatest_error_of_t = 0;

  [[nodiscard]] std::size_t faults() const;
};

/// Judges several engines' answers to the rays of one case.
class RayJudge {
 public:
  /// Threads    0: all.
  explicit RayJudge(const RayCase& rays, int threads = 0);
  ~RayJudge();
  RayJudge(const RayJudge&) = delete;
  RayJudge& operator=(const RayJudge&) = delete;

  [[nodiscard]] JudgedRays judge(const EngineAnswers& answers) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom::validation
