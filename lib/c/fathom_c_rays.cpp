#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "fathom/rays/cast.h"
#include "fathom/rays/hit_values.h"
#include "lib/c/calls.h"
#include "lib/c/fathom.h"

// The functions for rays. Rays and hits are copied to and from the caller's memory, whose strides
// may leave numbers unaligned.
using namespace fathom;
using namespace fathom::c;

struct fathom_rays {
  RayScene scene;
};

struct fathom_hits {
  const RayScene* scene;
  int threads;
  std::vector<Ray> ray_of_hit;
  std::vector<RayHit> hits;
  std::vector<std::uint64_t> splits;
};

namespace {

using Triple = std::array<double, 3>;

/// Where number `index` of an array with gaps is.
template <class Number>
Number* place_in(Number* first, std::size_t stride, std::size_t width, std::size_t index) {
  using Byte = std::conditional_t<std::is_const_v<Number>, const char, char>;
  const std::size_t step = stride == 0 ? width * sizeof(Number) : stride;
  return reinterpret_cast<Number*>(reinterpret_cast<Byte*>(first) + index * step);
}

Triple triple_in(const double* first, std::size_t stride, std::size_t index) {
  Triple numbers;
  std::memcpy(numbers.data(), place_in(first, stride, 3, index), sizeof numbers);
  return numbers;
}

std::vector<Ray> rays_of(const fathom_ray_array* given) {
  require(given, "given: NULL");
  require((given->origins && given->directions) || given->count == 0,
          "origins and directions: NULL");
  require_count("count", given->count, sizeof(Ray));
  std::vector<Ray> rays(given->count);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i] = {triple_in(given->origins, given->origin_stride, i),
               triple_in(given->directions, given->direction_stride, i)};
  }
  return rays;
}

CastOptions options_of(const fathom_cast_options* given) {
  CastOptions options;
  if (!given) return options;
  options.segment = {given->t_min, given->t_max, given->open != 0};
  options.cull = cull_of(given->cull);
  options.threads = given->threads;
  return options;
}

/// Writes values of hits where the caller wants them.
class HitWriter {
 public:
  HitWriter(const fathom_hit_arrays& to, const TriangleSource& triangles)
      : to_(to), triangles_(triangles) {}

  [[nodiscard]] bool wants_values() const {
    return to_.distance || to_.position || to_.barycentric || to_.normal;
  }

  void write(std::size_t i, const RayHit& hit) const {
    put(to_.triangle, i, std::array{hit.triangle});
    put(to_.t, i, std::array{hit.t});
    if (!to_.object && !to_.face) return;
    TriangleOrigin origin{.object = no_triangle, .triangle = no_triangle, .face = no_triangle};
    if (hit.triangle != no_triangle) origin = triangles_.origin(hit.triangle);
    put(to_.object, i, std::array{origin.object});
    put(to_.face, i, std::array{origin.face});
  }

  void write(std::size_t i, const HitValues<double>& values) const {
    put(to_.distance, i, std::array{values.distance});
    put(to_.position, i, values.position);
    put(to_.barycentric, i, values.barycentric);
    put(to_.normal, i, values.normal);
  }

 private:
  template <class Number, std::size_t width>
  void put(Number* first, std::size_t i, const std::array<Number, width>& numbers) const {
    if (first) std::memcpy(place_in(first, to_.stride, width, i), numbers.data(), sizeof numbers);
  }

  const fathom_hit_arrays& to_;
  const TriangleSource& triangles_;
};

/// Everything is computed before the first number is written.
void write_hits(const RayScene& scene, std::span<const Ray> rays, std::span<const RayHit> hits,
                int threads, const fathom_hit_arrays& to) {
  const HitWriter writer(to, scene.triangles());
  std::vector<HitValues<double>> values;
  if (writer.wants_values()) {
    std::vector<std::uint32_t> met(hits.size());
    std::ranges::transform(hits, met.begin(), &RayHit::triangle);
    values = hit_values<double>(scene.triangles(), rays, met, threads);
  }
  for (std::size_t i = 0; i < hits.size(); ++i) writer.write(i, hits[i]);
  for (std::size_t i = 0; i < values.size(); ++i) writer.write(i, values[i]);
}

std::unique_ptr<fathom_hits> hits_of(const RayScene& scene, const std::vector<Ray>& rays,
                                     const CastOptions& options) {
  RayHitLists lists = all_hits(scene, rays, options);
  auto made = std::make_unique<fathom_hits>();
  made->scene = &scene;
  made->threads = options.threads;
  made->ray_of_hit.reserve(lists.hits.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    made->ray_of_hit.insert(made->ray_of_hit.end(), lists.splits[i + 1] - lists.splits[i], rays[i]);
  made->hits = std::move(lists.hits);
  made->splits.assign(lists.splits.begin(), lists.splits.end());
  return made;
}

}  // namespace

extern "C" {

fathom_status fathom_rays_new(const fathom_scene* scene, int threads, fathom_rays** rays) {
  return status_of([&] {
    require(scene && rays, "scene and rays: NULL");
    *rays = std::make_unique<fathom_rays>(fathom_rays{RayScene(scene->scene, threads)}).release();
  });
}

void fathom_rays_free(fathom_rays* rays) {
  answer_of([&] { delete rays; });
}

fathom_status fathom_cast(const fathom_rays* rays, const fathom_ray_array* given,
                          const fathom_cast_options* options, const fathom_hit_arrays* hits) {
  return status_of([&] {
    require(rays && hits, "rays and hits: NULL");
    const std::vector<Ray> all = rays_of(given);
    const CastOptions asked = options_of(options);
    write_hits(rays->scene, all, cast(rays->scene, all, asked), asked.threads, *hits);
  });
}

fathom_status fathom_occluded(const fathom_rays* rays, const fathom_ray_array* given,
                              const fathom_cast_options* options, uint8_t* is_hit) {
  return status_of([&] {
    require(rays && is_hit, "rays and occluded: NULL");
    std::ranges::copy(occluded(rays->scene, rays_of(given), options_of(options)), is_hit);
  });
}

fathom_status fathom_count_hits(const fathom_rays* rays, const fathom_ray_array* given,
                                const fathom_cast_options* options, uint32_t* counts) {
  return status_of([&] {
    require(rays && counts, "rays and counts: NULL");
    std::ranges::copy(count_hits(rays->scene, rays_of(given), options_of(options)), counts);
  });
}

fathom_status fathom_all_hits(const fathom_rays* rays, const fathom_ray_array* given,
                              const fathom_cast_options* options, fathom_hits** hits) {
  return status_of([&] {
    require(rays && hits, "rays and hits: NULL");
    *hits = hits_of(rays->scene, rays_of(given), options_of(options)).release();
  });
}

void fathom_hits_free(fathom_hits* hits) {
  answer_of([&] { delete hits; });
}

uint64_t fathom_hits_count(const fathom_hits* hits) {
  return answer_of([&] { return std::uint64_t{hits ? hits->hits.size() : 0}; });
}

const uint64_t* fathom_hits_splits(const fathom_hits* hits) {
  return answer_of([&] { return hits ? hits->splits.data() : nullptr; });
}

fathom_status fathom_hits_values(const fathom_hits* hits, const fathom_hit_arrays* values) {
  return status_of([&] {
    require(hits && values, "hits and values: NULL");
    write_hits(*hits->scene, hits->ray_of_hit, hits->hits, hits->threads, *values);
  });
}

fathom_status fathom_contains(const fathom_rays* rays, const double* points, size_t count,
                              size_t stride, int threads, uint8_t* inside) {
  return status_of([&] {
    require(rays && ((points && inside) || count == 0), "rays, points and inside: NULL");
    require_count("count", count, sizeof(Triple));
    std::vector<Triple> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = triple_in(points, stride, i);
    std::ranges::copy(contains(rays->scene, all, threads), inside);
  });
}

}  // extern "C"
