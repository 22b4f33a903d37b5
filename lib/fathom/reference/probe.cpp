#include "fathom/reference/probe.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/deciders.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/sampling.h"
#include "fathom/triangle/triangle_boxes.h"

namespace fathom {
using namespace triangle;

namespace {

/// Exact arithmetic only, without any filter, so that the engines can be checked against it.
std::array<Sign, 3> edge_signs(const ProjectedTriangle& t, const ImagePoint& s) {
  std::array<Sign, 3> signs{};
  for (std::size_t i = 0; i < 3; ++i) signs[i] = t.edges[i].at(s.u, s.v).sign();
  return signs;
}

/// Which signs an interval would settle: those that the reference engine does not ask dyadic
/// numbers for.
std::array<bool, 3> edges_by_interval(const ProjectedTriangle& t, const ImagePoint& s) {
  std::array<bool, 3> by_interval{};
  for (std::size_t i = 0; i < 3; ++i) {
    TierCounts tiers;
    [[maybe_unused]] const Sign sign = t.edges[i].sign_at(s.u, s.v, tiers);
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

/// The triangles of one object at one sample.
class ObjectProbe {
 public:
  ObjectProbe(const Scene& scene, const Object& object, std::uint32_t first_number,
              const Camera& camera, const ImagePoint& s, Cull cull)
      : scene_(scene),
        object_(object),
        mesh_(scene.meshes[object.mesh]),
        first_number_(first_number),
        camera_(camera),
        s_(s),
        cull_(cull),
        sides_(sides_of_vertices(SampleSides(object, camera, s))) {}

  /// In the order of their numbers.
  [[nodiscard]] std::vector<CoveringTriangle> covering(Progress& progress) const {
    const std::size_t count = mesh_.triangles.size();
    std::vector<std::vector<CoveringTriangle>> found(chunks(count));
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
    std::vector<CoveringTriangle> all;
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
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return (sides_[a] & sides_[b] & sides_[c]) != 0;
  }

  /// Nothing if the triangle does not cover the sample.
  [[nodiscard]] std::optional<CoveringTriangle> at_sample(std::uint32_t triangle) const {
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
                       .edge_by_interval = edges_by_interval(t, s_),
                       .depth = depth_at(t, s_)};
    c.counts = is_in_range(c.depth, camera_) && is_kept(t, cull_);
    return c;
  }

  const Scene& scene_;
  const Object& object_;
  const Mesh& mesh_;
  std::uint32_t first_number_;
  const Camera& camera_;
  ImagePoint s_;
  Cull cull_;
  std::vector<SampleSides::Sides> sides_;
};

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
  require_renderable(scene, camera);
  const ImagePoint s = centre_of_pixel(x, y);
  Progress parts(progress, chunks_of(scene));
  std::vector<CoveringTriangle> covering;
  std::uint32_t first_number = 0;
  for (const Object& object : scene.objects) {
    const ObjectProbe probe(scene, object, first_number, camera, s, cull);
    for (CoveringTriangle& each : probe.covering(parts)) covering.push_back(std::move(each));
    first_number += static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size());
  }
  std::stable_sort(covering.begin(), covering.end(), [](const auto& a, const auto& b) {
    if (a.counts != b.counts) return a.counts;
    return a.depth < b.depth;
  });
  return covering;
}

}  // namespace fathom
