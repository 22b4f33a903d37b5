#include "fathom/rays/cast.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/fused_multiply_add.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/candidates.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/rays/walk_ray.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::rays {
namespace {

/// Magnitudes with which no product of three differences over- or underflows in double-words.
bool is_safe(const Vector& v) {
  for (const double x : v) {
    const double size = std::abs(x);
    if (!(size <= greatest_safe) || (size < least_safe && size != 0)) return false;
  }
  return true;
}

/// v times 2^power into `to`, if that is exact and safe.
bool scale_safely(const std::array<double, 3>& v, long power, Vector& to) {
  for (std::size_t k = 0; k < 3; ++k) {
    to[k] = std::ldexp(v[k], static_cast<int>(power));
    if (to[k] == 0 && v[k] != 0) return false;
  }
  return is_safe(to);
}

template <bool fused>
using Number = Certified<DoubleWord<fused>>;

/// Differences of binary64 numbers are double-words exactly.
template <bool fused>
std::array<Number<fused>, 3> displacement(const Vector& to, const Vector& from) {
  std::array<Number<fused>, 3> result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = {two_sum(to[k], -from[k]), 0};
  return result;
}

/// n·(a − o) / n·d.
template <bool fused>
Certified<WordPair> t_in_double_words(const std::array<Vector, 3>& corners, const Vector& origin,
                                      const Vector& direction) {
  const auto p = displacement<fused>(corners[1], corners[0]);
  const auto r = displacement<fused>(corners[2], corners[0]);
  const auto from_origin = displacement<fused>(corners[0], origin);
  Number<fused> height{{}, 0}, along{{}, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Number<fused> first = product(p[i], r[j]), second = product(p[j], r[i]);
    const Number<fused> n = sum(first, Number<fused>{-second.value, second.error});
    height = sum(height, product(n, from_origin[k]));
    along = sum(along, product(n, Number<fused>{direction[k], 0}));
  }
  const Number<fused> t = quotient(height, along);
  return {t.value, t.error};
}

FATHOM_WITH_FMA Certified<WordPair> t_with_fma(const std::array<Vector, 3>& corners,
                                               const Vector& origin, const Vector& direction) {
  return t_in_double_words<true>(corners, origin, direction);
}

/// In the unit of the tree, with a direction of about 1. nullopt where that is not settled.
std::optional<double> settled_t(const RayScene& scene, const Ray& ray, const Candidates::Hit& hit) {
  const RayTree& tree = scene.tree();
  if (!tree.has_exact_corners(scene.triangles().origin(hit.first).object)) return std::nullopt;
  const long direction_power = power_of_direction(ray);
  Vector origin, direction;
  if (!scale_safely(ray.origin, -tree.power(), origin) ||
      !scale_safely(ray.direction, -direction_power, direction))
    return std::nullopt;
  const std::array<Vector, 3> corners = tree.corners(hit.place);
  for (const Vector& corner : corners)
    if (!is_safe(corner)) return std::nullopt;
  static const bool has_fma = processor_has_fma();
  const Certified<WordPair> t = has_fma ? t_with_fma(corners, origin, direction)
                                        : t_in_double_words<false>(corners, origin, direction);
  const auto settled = to_binary64(t.value, t.error);
  if (!settled) return std::nullopt;
  // Scaled back without another rounding: the result is normal.
  const auto power = static_cast<int>(tree.power() - direction_power);
  const double result = std::ldexp(*settled, power);
  if (*settled != 0 && !std::isnormal(result)) return std::nullopt;
  return result;
}

/// t of a hit that was found for a ray, rounded once: in double-words if their bounds settle it,
/// otherwise by exact numbers.
double rounded_t(const RayScene& scene, const Ray& ray, Candidates& found,
                 const Candidates::Hit& hit) {
  if (const auto settled = settled_t(scene, ray, hit)) return *settled;
  return round_to_binary64(found.exact_t(hit));
}

}  // namespace
}  // namespace fathom::rays

namespace fathom {
namespace {

using rays::Candidates;
using rays::Question;

void require_segment(const RaySegment& segment) {
  if (!(segment.t_min <= segment.t_max))
    throw UsageError(Setting{"t_min"}, "expected a number that is at most t_max");
}

void require_ray(const Ray& ray, std::size_t number) {
  const auto fail = [&](const std::string& fault) {
    throw InputError("ray " + std::to_string(number) + ": " + fault);
  };
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(ray.origin, is_finite)) fail("its origin is not finite");
  if (!std::ranges::all_of(ray.direction, is_finite)) fail("its direction is not finite");
  if (ray.direction == std::array<double, 3>{}) fail("its direction is 0");
}

/// The number of rays in a piece of work.
constexpr std::size_t rays_together = 512;

/// Calls answer(number, candidates) for each ray after a walk along it, several rays at the same
/// time; those of a piece one after another.
template <class Answer>
void for_each_ray(const RayScene& scene, std::span<const Ray> given, const CastOptions& options,
                  Question question, const Answer& answer) {
  require_segment(options.segment);
  for (std::size_t i = 0; i < given.size(); ++i) require_ray(given[i], i);
  const std::size_t pieces = (given.size() + rays_together - 1) / rays_together;
  const auto cast_piece = [&](std::size_t piece) {
    Candidates candidates(scene.triangles(), scene.tree(), options, question);
    const std::size_t first = piece * rays_together;
    for (std::size_t i = first; i < std::min(given.size(), first + rays_together); ++i) {
      check_interruption();
      const auto ray = rays::prepare(given[i], options.segment, scene.tree());
      if (!ray) continue;
      candidates.begin(given[i], *ray);
      rays::walk(scene.tree(), *ray, candidates);
      answer(i, candidates);
    }
  };
  run_with_threads(options.threads, [&] { in_parallel(pieces, cast_piece); });
}

std::vector<bool> to_bool(const std::vector<std::uint8_t>& flags) {
  return {flags.begin(), flags.end()};
}

}  // namespace

RayScene::RayScene(const Scene& scene, int threads) : triangles_(scene) {
  const StandardArithmetic standard;
  require_valid(scene);
  run_with_threads(threads, [&] { tree_ = std::make_unique<const rays::RayTree>(triangles_); });
}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

std::uint64_t RayScene::bytes() const {
  return tree_->nodes().size() * sizeof(rays::TreeNode) +
         tree_->blocks<float>().size() * sizeof(rays::TriangleBlock<float>) +
         tree_->blocks<double>().size() * sizeof(rays::TriangleBlock<double>) +
         tree_->repetition_count() * sizeof(rays::Repetition);
}

std::vector<RayHit> cast(const RayScene& scene, std::span<const Ray> rays,
                         const CastOptions& options) {
  const StandardArithmetic standard;
  std::vector<RayHit> hits(rays.size());
  for_each_ray(scene, rays, options, Question::nearest, [&](std::size_t i, Candidates& found) {
    if (const auto hit = found.nearest())
      hits[i] = {hit->triangle, rays::rounded_t(scene, rays[i], found, *hit)};
  });
  return hits;
}

std::vector<bool> occluded(const RayScene& scene, std::span<const Ray> rays,
                           const CastOptions& options) {
  const StandardArithmetic standard;
  std::vector<std::uint8_t> is_hit(rays.size());
  for_each_ray(scene, rays, options, Question::any, [&](std::size_t i, const Candidates& found) {
    is_hit[i] = found.hits().empty() ? 0 : 1;
  });
  return to_bool(is_hit);
}

std::vector<std::uint32_t> count_hits(const RayScene& scene, std::span<const Ray> rays,
                                      const CastOptions& options) {
  const StandardArithmetic standard;
  std::vector<std::uint32_t> counts(rays.size());
  for_each_ray(scene, rays, options, Question::all, [&](std::size_t i, const Candidates& found) {
    counts[i] = static_cast<std::uint32_t>(found.hits().size());
  });
  return counts;
}

RayHitLists all_hits(const RayScene& scene, std::span<const Ray> rays, const CastOptions& options) {
  const StandardArithmetic standard;
  std::vector<std::size_t> counts(rays.size());
  std::vector<std::vector<RayHit>> of_pieces(rays.size() / rays_together + 1);
  for_each_ray(scene, rays, options, Question::all, [&](std::size_t i, Candidates& found) {
    found.sort();
    counts[i] = found.hits().size();
    for (const Candidates::Hit& hit : found.hits())
      of_pieces[i / rays_together].push_back(
          {hit.triangle, rays::rounded_t(scene, rays[i], found, hit)});
  });
  RayHitLists lists;
  lists.splits.resize(rays.size() + 1);
  std::inclusive_scan(counts.begin(), counts.end(), lists.splits.begin() + 1);
  lists.hits.reserve(lists.splits.back());
  for (std::vector<RayHit>& piece : of_pieces) {
    lists.hits.insert(lists.hits.end(), piece.begin(), piece.end());
    piece = {};
  }
  return lists;
}

// Along +x, n·d is the x of n and not 0, so that the moved origin meets the plane ε earlier: a hit
// at t = 0 is behind it.
std::vector<std::int64_t> winding_numbers(const RayScene& scene,
                                          std::span<const std::array<double, 3>> points,
                                          int threads) {
  const StandardArithmetic standard;
  std::vector<Ray> rays(points.size());
  std::ranges::transform(points, rays.begin(), [](const auto& point) {
    return Ray{point, {1, 0, 0}};
  });
  std::vector<std::int64_t> numbers(points.size());
  const CastOptions beyond{.segment = {.open = true}, .threads = threads};
  for_each_ray(scene, rays, beyond, Question::all, [&](std::size_t i, const Candidates& found) {
    for (const Candidates::Hit& hit : found.hits()) numbers[i] += static_cast<int>(hit.side);
  });
  return numbers;
}

std::vector<bool> contains(const RayScene& scene, std::span<const std::array<double, 3>> points,
                           int threads) {
  const StandardArithmetic standard;
  const std::vector<std::int64_t> numbers = winding_numbers(scene, points, threads);
  std::vector<bool> inside(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) inside[i] = numbers[i] != 0;
  return inside;
}

}  // namespace fathom
