#include "fathom/reference/probe.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "fathom/lens/preimages.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/ray_decisions.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/ray_values.h"
#include "fathom/triangle/stored_quantity.h"
#include "fathom/triangle/triangle_boxes.h"

namespace fathom {
using namespace reference;
using namespace triangle;

namespace {

/// Exact arithmetic only, without any filter, so that the engines can be checked against it.
std::array<Sign, 3> edge_signs(const ProjectedTriangle& t, const Sample& s) {
  std::array<Sign, 3> signs{};
  for (std::size_t i = 0; i < 3; ++i) {
    signs[i] = s.direction() ? s.direction()->sign_of(t.edges[i].coefficients())
                             : t.edges[i].at(s.point().u, s.point().v).sign();
  }
  return signs;
}

/// The signs that an interval would settle, for which the reference engine uses no exact numbers.
std::array<bool, 3> edges_by_interval(const ProjectedTriangle& t, const Sample& s) {
  std::array<bool, 3> by_interval{};
  for (std::size_t i = 0; i < 3; ++i) {
    TierCounts tiers;
    [[maybe_unused]] const Sign sign = s.sign_of(t.edges[i], tiers);
    by_interval[i] = tiers.interval > 0;
  }
  return by_interval;
}

bool covers(const std::array<Sign, 3>& signs, const std::array<bool, 3>& left_or_top) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (signs[i] == Sign::negative || (signs[i] == Sign::zero && !left_or_top[i])) return false;
  }
  return true;
}

Standing standing_at(const Ratio& depth, const Camera& camera) {
  if (depth.sign() != Sign::positive) return Standing::behind;
  if (depth < Ratio(Dyadic(camera.near))) return Standing::before_near;
  return std::isfinite(camera.far) && Ratio(Dyadic(camera.far)) < depth ? Standing::beyond_far
                                                                        : Standing::counts;
}

/// Along a ray: signs of forms, each limit by itself.
Standing standing_along(const ProjectedTriangle& t, const lens::ExactDirection& d,
                        const Camera& camera) {
  TierCounts counts;
  const Sample s(d);
  if (DepthRange(t, camera).contains(s, counts)) return Standing::counts;
  if (!counts_distance(camera.projection) &&
      d.sign_of(t.depth_numerator.coefficients()) != Sign::positive) {
    return Standing::behind;
  }
  Camera without_far = camera;
  without_far.far = std::numeric_limits<double>::infinity();
  return DepthRange(t, without_far).contains(s, counts) ? Standing::beyond_far
                                                        : Standing::before_near;
}

void set_depth_along(const ProjectedTriangle& t, const lens::ExactDirection& d,
                     const Camera& camera, CoveringTriangle& c) {
  constexpr long bits = 192;
  const Real depth = quotient_at(d, t.depth_numerator, t.weight);
  c.depth_is_exact = d.rational() != nullptr;
  c.depth = c.depth_is_exact ? *depth.rational() : depth.enclose(bits).low;
  c.stored_depth = binary32_at(d, t.depth_numerator, t.weight);
  if (!counts_distance(camera.projection)) return;
  const QuadraticForm squared = (t.volume * t.volume) * squared_length();
  c.stored_distance = to_binary32(
      Quantity<Real>{quotient_at(d, squared, square_of(t.weight.coefficients())), true});
}

constexpr std::size_t items_per_chunk = 4096;

std::size_t chunks(std::size_t items) {
  return (items + items_per_chunk - 1) / items_per_chunk;
}

/// The steps of progress: the triangles of each object.
std::uint64_t chunks_of(const Scene& scene) {
  std::uint64_t all = 0;
  for (const Object& object : scene.objects) {
    all += chunks(scene.meshes[object.mesh].triangles.size());
  }
  return all;
}

/// A triangle that covers the sample; the exact one where the sample has a bent ray.
struct Found {
  CoveringTriangle triangle;
  std::optional<ProjectedTriangle> along_ray;
};

/// The triangles of one object at one sample.
class ObjectProbe {
 public:
  ObjectProbe(const Scene& scene, const Object& object, std::uint32_t first_number,
              const Camera& camera, const Sample& s, Cull cull)
      : scene_(scene),
        object_(object),
        mesh_(scene.meshes[object.mesh]),
        first_number_(first_number),
        camera_(camera),
        s_(s),
        cull_(cull) {
    if (!s.direction()) sides_ = sides_of_vertices(SampleSides(object, camera, s.point()));
  }

  /// In the order of their numbers.
  [[nodiscard]] std::vector<Found> covering(Progress& progress) const {
    const std::size_t count = mesh_.triangles.size();
    std::vector<std::vector<Found>> found(chunks(count));
    parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
      const std::size_t end = std::min(count, (k + 1) * items_per_chunk);
      for (std::size_t i = k * items_per_chunk; i < end; ++i) {
        if (is_on_one_side(i)) continue;
        if (auto each = at_sample(static_cast<std::uint32_t>(i))) {
          found[k].push_back(std::move(*each));
        }
      }
      progress.part_done();
    });
    std::vector<Found> all;
    for (auto& part : found) std::move(part.begin(), part.end(), std::back_inserter(all));
    return all;
  }

 private:
  [[nodiscard]] std::vector<SampleSides::Sides> sides_of_vertices(const SampleSides& sides) const {
    std::vector<SampleSides::Sides> all(mesh_.vertices.size());
    parallel_for(std::size_t{0}, chunks(all.size()), [&](std::size_t k) {
      const std::size_t end = std::min(all.size(), (k + 1) * items_per_chunk);
      for (std::size_t i = k * items_per_chunk; i < end; ++i) all[i] = sides.of(mesh_.vertices[i]);
    });
    return all;
  }

  [[nodiscard]] bool is_on_one_side(std::size_t triangle) const {
    if (sides_.empty()) return false;
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return (sides_[a] & sides_[b] & sides_[c]) != 0;
  }

  /// Nothing if the triangle does not cover the sample.
  [[nodiscard]] std::optional<Found> at_sample(std::uint32_t triangle) const {
    TierCounts facing;
    const std::uint32_t number = first_number_ + triangle;
    const ProjectedTriangle t =
        project(world_corners(object_, mesh_, triangle), number, camera_, facing);
    if (t.orientation == Sign::zero) return std::nullopt;
    const std::array<Sign, 3> signs = edge_signs(t, s_);
    if (!covers(signs, t.left_or_top)) return std::nullopt;
    CoveringTriangle c{.number = number,
                       .origin = origin_of(scene_, number),
                       .edge_signs = signs,
                       .left_or_top = t.left_or_top,
                       .front_facing = t.front_facing(),
                       .facing_by_interval = facing.interval > 0,
                       .edge_by_interval = edges_by_interval(t, s_)};
    if (s_.direction()) {
      set_depth_along(t, *s_.direction(), camera_, c);
      c.standing = standing_along(t, *s_.direction(), camera_);
    } else {
      c.depth = depth_at(t, s_.point());
      c.stored_depth = round_to_binary32(c.depth);
      c.standing = standing_at(c.depth, camera_);
    }
    if (c.standing == Standing::counts && !is_kept(t, cull_)) c.standing = Standing::culled;
    c.counts = c.standing == Standing::counts;
    if (!s_.direction()) return Found{std::move(c), std::nullopt};
    return Found{std::move(c), t};
  }

  const Scene& scene_;
  const Object& object_;
  const Mesh& mesh_;
  std::uint32_t first_number_;
  const Camera& camera_;
  const Sample& s_;
  Cull cull_;
  /// Of each vertex; empty where the sample has a bent ray.
  std::vector<SampleSides::Sides> sides_;
};

/// Positive if `a` is nearer than `b`.
Sign order_of(const Found& a, const Found& b, const Sample& s) {
  if (s.direction()) return order_along(*a.along_ray, *b.along_ray, *s.direction());
  const int order = compare(b.triangle.depth, a.triangle.depth);
  return order > 0 ? Sign::positive : order < 0 ? Sign::negative : Sign::zero;
}

std::vector<CoveringTriangle> probe_sample(const Scene& scene, const Camera& camera,
                                           const Sample& s, Cull cull, Progress& parts) {
  std::vector<Found> covering;
  std::uint32_t first_number = 0;
  for (const Object& object : scene.objects) {
    const ObjectProbe probe(scene, object, first_number, camera, s, cull);
    for (Found& each : probe.covering(parts)) covering.push_back(std::move(each));
    first_number += static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size());
  }
  std::stable_sort(covering.begin(), covering.end(), [&](const Found& a, const Found& b) {
    if (a.triangle.counts != b.triangle.counts) return a.triangle.counts;
    return order_of(a, b, s) == Sign::positive;
  });
  std::vector<CoveringTriangle> triangles;
  for (Found& each : covering) {
    each.triangle.as_near_as_first = order_of(covering.front(), each, s) == Sign::zero;
    triangles.push_back(each.triangle);
  }
  return triangles;
}

}  // namespace

std::string_view CoveringTriangle::facing_decided_by() const {
  return facing_by_interval ? cgal_determinant : dyadic_numbers;
}

std::string_view CoveringTriangle::edge_decided_by(std::size_t i) const {
  return edge_by_interval[i] ? cgal_form : dyadic_numbers;
}

std::vector<CoveringTriangle> probe(const Scene& scene, const Camera& camera, std::uint32_t x,
                                    std::uint32_t y, Cull cull,
                                    const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_renderable_by_rays(scene, camera);
  Progress parts(progress, chunks_of(scene));
  if (!bends_rays(camera.projection))
    return probe_sample(scene, camera, Sample(centre_of_pixel(x, y)), cull, parts);
  const lens::Preimages preimages(camera.projection, *camera.projection.lens);
  const auto ray = preimages.of_pixel(x, y);
  return ray ? probe_sample(scene, camera, Sample(*ray), cull, parts)
             : std::vector<CoveringTriangle>();
}

}  // namespace fathom
