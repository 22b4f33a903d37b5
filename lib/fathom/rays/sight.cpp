#include "fathom/rays/sight.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/camera_sight.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/rays/ray_tree.h"
#include "fathom/rays/sight_line.h"
#include "fathom/rays/walk_ray.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

using rays::SightEnd;

constexpr RaySegment between_ends{.t_min = 0, .t_max = 1, .open = true};

/// Finds a triangle that hides two ends from each other.
class HidingTriangle final : public rays::TriangleVisitor {
 public:
  HidingTriangle(const TriangleSource& source, const SightEnd& eye, const SightEnd& point,
                 EdgeRule edges, const rays::WalkRay& ray)
      : source_(source), eye_(eye), point_(point), edges_(edges), ray_(ray) {
    set_last(ray.last);
  }

  bool offer(const rays::TestedTriangle& triangle) override {
    if (triangle.number == eye_.triangle() || triangle.number == point_.triangle()) return false;
    const Interval s = triangle.s();
    if (s.upper < ray_.segment_first.lower || s.lower > ray_.segment_last.upper) return false;
    const bool is_between = s.lower > ray_.segment_first.upper && s.upper < ray_.segment_last.lower;
    is_found_ = (triangle.is_met && is_between) || hides(triangle.number);
    return is_found_;
  }
  [[nodiscard]] bool is_found() const { return is_found_; }

 private:
  [[nodiscard]] bool hides(std::uint32_t triangle) {
    if (!exact_) exact_ = rays::ray_between(eye_.exact(source_), point_.exact(source_));
    const auto hit = rays::meet(*exact_, source_.world_corners(triangle), edges_);
    return hit && rays::counts(hit->t, between_ends);
  }

  const TriangleSource& source_;
  const SightEnd &eye_, &point_;
  EdgeRule edges_;
  /// From one of the ends to the other.
  const rays::WalkRay& ray_;
  std::optional<rays::ExactRay> exact_;
  bool is_found_ = false;
};

/// The walk between the ends, from one that is near the scene; nullopt if nothing is between them.
std::optional<rays::WalkRay> walk_between(const RayScene& scene, const SightEnd& eye,
                                          const SightEnd& point) {
  if (auto ray = rays::prepare_between(eye.near(), point.near())) return ray;
  if (auto ray = rays::prepare_between(point.near(), eye.near())) return ray;
  const TriangleSource& source = scene.triangles();
  const rays::ExactRay exact = rays::ray_between(eye.exact(source), point.exact(source));
  if (std::ranges::all_of(exact.direction, &Dyadic::is_zero)) return std::nullopt;
  return rays::prepare(exact, between_ends, scene.tree());
}

bool sees(const RayScene& scene, const SightEnd& eye, const SightEnd& point, EdgeRule edges) {
  const auto ray = walk_between(scene, eye, point);
  if (!ray) return true;
  HidingTriangle hiding(scene.triangles(), eye, point, edges, *ray);
  rays::walk(scene.tree(), *ray, hiding);
  return !hiding.is_found();
}

void require_points(const RayScene& scene, std::span<const SightPoint> points, const char* name) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fail = [&](const std::string& fault) {
      throw InputError(std::string(name) + " " + std::to_string(i) + ": " + fault);
    };
    if (const auto* const place = std::get_if<std::array<double, 3>>(&points[i])) {
      if (!std::ranges::all_of(*place, is_finite)) fail("its coordinates are not finite");
      continue;
    }
    const auto& on_surface = std::get<SurfacePoint>(points[i]);
    if (on_surface.triangle >= scene.triangles().count())
      fail("there is no triangle " + std::to_string(on_surface.triangle));
    if (!is_finite(on_surface.v) || !is_finite(on_surface.w)) fail("its weights are not finite");
  }
}

std::vector<SightEnd> ends_of(const RayScene& scene, std::span<const SightPoint> points,
                              int threads) {
  const auto end_of = [&](const SightPoint& point) {
    return SightEnd(point, scene.triangles(), scene.tree().power());
  };
  std::vector<SightEnd> ends(points.size(), end_of(std::array<double, 3>{}));
  run_with_threads(threads, [&] {
    parallel_for(std::size_t{0}, points.size(),
                 [&](std::size_t i) { ends[i] = end_of(points[i]); });
  });
  return ends;
}

/// The answers to questions 0 … count − 1, several at the same time.
template <class Answer>
std::vector<bool> answers(std::size_t count, int threads, const Answer& answer) {
  constexpr std::size_t together = 512;
  std::vector<std::uint8_t> are_true(count);
  const auto answer_piece = [&](std::size_t piece) {
    const std::size_t first = piece * together;
    for (std::size_t i = first; i < std::min(count, first + together); ++i) {
      check_interruption();
      are_true[i] = answer(i) ? 1 : 0;
    }
  };
  run_with_threads(threads, [&] { in_parallel((count + together - 1) / together, answer_piece); });
  return {are_true.begin(), are_true.end()};
}

}  // namespace

std::vector<bool> sees(const RayScene& scene, std::span<const SightPoint> eyes,
                       std::span<const SightPoint> points, const SightOptions& options) {
  const StandardArithmetic standard;
  if (eyes.size() != points.size())
    throw UsageError(Setting{"points"}, "expected as many as eyes, " + std::to_string(eyes.size()));
  require_points(scene, eyes, "eye");
  require_points(scene, points, "point");
  const auto from = ends_of(scene, eyes, options.threads);
  const auto to = ends_of(scene, points, options.threads);
  return answers(points.size(), options.threads,
                 [&](std::size_t i) { return sees(scene, from[i], to[i], options.edges); });
}

std::vector<bool> sees_each(const RayScene& scene, std::span<const SightPoint> eyes,
                            std::span<const SightPoint> points, const SightOptions& options) {
  const StandardArithmetic standard;
  require_points(scene, eyes, "eye");
  require_points(scene, points, "point");
  const auto from = ends_of(scene, eyes, options.threads);
  const auto to = ends_of(scene, points, options.threads);
  return answers(from.size() * to.size(), options.threads, [&](std::size_t i) {
    return sees(scene, from[i / to.size()], to[i % to.size()], options.edges);
  });
}

std::vector<bool> seen_by(const RayScene& scene, std::span<const SightPoint> points,
                          std::span<const Camera> cameras, Cull cull, int threads) {
  const StandardArithmetic standard;
  require_points(scene, points, "point");
  std::vector<rays::CameraSight> sights;
  for (const Camera& camera : cameras) {
    require_valid(camera);
    require_straight(camera);
    sights.emplace_back(scene, camera, cull);
  }
  const auto ends = ends_of(scene, points, threads);
  return answers(ends.size() * sights.size(), threads, [&](std::size_t i) {
    return sights[i % sights.size()].sees(ends[i / sights.size()]);
  });
}

}  // namespace fathom
