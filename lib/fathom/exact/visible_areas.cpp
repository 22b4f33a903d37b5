#include "fathom/exact/visible_areas.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "fathom/exact/engine_frame.h"
#include "fathom/exact/scene_surfaces.h"
#include "fathom/exact/visible_fragments.h"
#include "fathom/numeric/enclosed_sum.h"
#include "fathom/numeric/rounding.h"

namespace fathom {
namespace {

/// Exact areas of a triangle.
struct ExactAreas {
  Ratio visible, unoccluded;
  /// Visible if its object were alone.
  Ratio in_object;
};

/// a / b
Ratio quotient(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.denominator, a.denominator * b.numerator};
}

VisibleArea rounded(const Ratio& visible, const Ratio& unoccluded) {
  VisibleArea area{round_to_binary64(visible), round_to_binary64(unoccluded), std::nullopt};
  if (unoccluded.sign() != Sign::zero) {
    area.ratio = round_to_binary64(quotient(visible, unoccluded));
  }
  return area;
}

class SceneAreas {
 public:
  SceneAreas(const CoverageFrame& frame) : triangles_(frame.triangles), surfaces_(frame) {}

  [[nodiscard]] std::uint32_t count() const { return surfaces_.count(); }
  [[nodiscard]] std::uint32_t object_of(std::uint32_t number) const {
    return triangles_.origin(number).object;
  }

  /// Everything happens within the box of the triangle.
  [[nodiscard]] ExactAreas of(std::uint32_t number) const {
    const SurfaceRegion* surface = surfaces_.surface(number);
    if (!surface) return {};
    ImageCell cell = cell_of(surfaces_.box(number));
    CellVisibility visibility(cell);
    if (!visibility.add(*surface)) return {};
    for (const std::uint32_t other : surfaces_.near(number)) {
      visibility.add(*surfaces_.surface(other));
    }
    ExactAreas areas;
    areas.visible = area(visibility.visible(0));
    const ConvexPolygon polygons[] = {visibility.polygon(0)};
    areas.unoccluded = area(boundary_of_union(polygons, visibility.decisions()));
    areas.in_object = areas.visible;
    if (triangles_.objects().size() > 1) {
      const std::uint32_t object = object_of(number);
      areas.in_object = area(visibility.visible(
          0, [&](const SurfaceRegion& other) { return object_of(other.number) == object; }));
    }
    return areas;
  }

 private:
  TriangleSource triangles_;
  SceneSurfaces surfaces_;
};

struct ObjectSums {
  EnclosedSum visible, in_object;
};

/// The exact areas of an object, where their enclosures do not settle how they round.
VisibleArea rounded_exactly(const SceneAreas& areas, std::uint32_t object) {
  Ratio visible, in_object;
  for (std::uint32_t number = 0; number < areas.count(); ++number) {
    if (areas.object_of(number) != object) continue;
    const ExactAreas exact = areas.of(number);
    visible = visible + exact.visible;
    in_object = in_object + exact.in_object;
  }
  return rounded(visible, in_object);
}

VisibleArea rounded(const SceneAreas& areas, const ObjectSums& sums, std::uint32_t object) {
  const Enclosure visible = sums.visible.get(), alone = sums.in_object.get();
  if (alone.high.sign() == Sign::zero) return {};
  if (alone.low.sign() == Sign::zero) return rounded_exactly(areas, object);
  const VisibleArea low = rounded(visible.low, alone.low), high = rounded(visible.high, alone.high);
  const double least = round_to_binary64(quotient(visible.low, alone.high));
  const double greatest = round_to_binary64(quotient(visible.high, alone.low));
  const bool settled =
      low.visible == high.visible && low.unoccluded == high.unoccluded && least == greatest;
  if (!settled) return rounded_exactly(areas, object);
  return {low.visible, low.unoccluded, least};
}

VisibleAreas areas_in_arena(const CoverageFrame& frame, const RenderOptions& options) {
  const SceneAreas areas(frame);
  const std::size_t objects = frame.triangles.objects().size();
  VisibleAreas result;
  result.triangles.resize(areas.count());
  tbb::enumerable_thread_specific<std::vector<ObjectSums>> parts(
      [&] { return std::vector<ObjectSums>(objects); });
  constexpr std::uint32_t chunk = 64;
  const std::uint32_t chunks = areas.count() / chunk + 1;
  Progress progress(options.progress, chunks);
  tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t k) {
    const std::uint32_t end = std::min(areas.count(), (k + 1) * chunk);
    for (std::uint32_t number = k * chunk; number < end; ++number) {
      const ExactAreas exact = areas.of(number);
      result.triangles[number] = rounded(exact.visible, exact.unoccluded);
      ObjectSums& sums = parts.local()[areas.object_of(number)];
      sums.visible.add(exact.visible);
      sums.in_object.add(exact.in_object);
    }
    progress.part_done();
  });
  std::vector<ObjectSums> sums(objects);
  for (const auto& part : parts) {
    for (std::size_t object = 0; object < objects; ++object) {
      sums[object].visible.add(part[object].visible);
      sums[object].in_object.add(part[object].in_object);
    }
  }
  for (std::uint32_t object = 0; object < objects; ++object) {
    result.objects.push_back(rounded(areas, sums[object], object));
  }
  return result;
}

}  // namespace

VisibleAreas visible_areas(const TriangleSource& triangles, const Camera& camera,
                           const RenderOptions& options) {
  return with_threads(options.threads, [&] {
    return areas_in_arena({triangles, camera, options.cull}, options);
  });
}

}  // namespace fathom
