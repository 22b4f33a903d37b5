#include "fathom/area/reference_areas.h"

#include "fathom/area/area_rounding.h"
#include "fathom/area/cell_coverage.h"
#include "fathom/area/cell_division.h"
#include "fathom/area/scene_surfaces.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/numeric/real.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;
using namespace triangle;

namespace {

/// Exact areas of a triangle.
struct ExactAreas {
  Ratio unoccluded;
  /// The areas of the parts that are visible, and of those visible if its object were alone.
  std::vector<Ratio> visible, in_object;
};

class SceneAreas {
 public:
  SceneAreas(const CoverageFrame& frame, Progress& progress)
      : triangles_(frame.triangles), surfaces_(frame, progress) {}

  [[nodiscard]] std::uint32_t count() const { return surfaces_.count(); }
  [[nodiscard]] std::uint32_t object_of(std::uint32_t number) const {
    return triangles_.origin(number).object;
  }

  /// Everything happens within the box of the triangle.
  [[nodiscard]] ExactAreas of(std::uint32_t number) const {
    const SurfaceRegion* surface = surfaces_.surface(number);
    if (!surface) return {};
    ImageCell cell = cell_of(surfaces_.box(number));
    CellVisibility all(cell);
    if (!all.add(*surface)) return {};
    CellVisibility in_object = all;
    // By triangles of any object, and of its own.
    CoveredParts hidden(cell, all.polygon(0)), hidden_in_object = hidden;
    bool is_hidden = !surfaces_.is_first(number);
    bool is_hidden_in_object = !surfaces_.is_first_of_object(number);
    bool are_same = is_hidden == is_hidden_in_object;
    std::vector<std::uint32_t> others;
    if (!is_hidden || !is_hidden_in_object) others = surfaces_.in_front(number);
    for (const std::uint32_t other : others) {
      check_interruption();
      const bool counts = !is_hidden && surfaces_.is_first(other);
      const bool counts_in_object = !is_hidden_in_object && object_of(other) == object_of(number) &&
                                    surfaces_.is_first_of_object(other);
      if (!counts && !counts_in_object) continue;
      const auto part = all.add_if_it_hides(*surfaces_.surface(other), 0);
      if (!part) continue;
      const bool added = counts && hidden.add(*part);
      const bool added_in_object = counts_in_object && hidden_in_object.add(*part);
      if (added_in_object) in_object.add_last_of(all);
      if (!added) all.drop_last();
      are_same &= added == added_in_object;
      is_hidden |= hidden.is_all();
      is_hidden_in_object |= hidden_in_object.is_all();
    }
    ExactAreas areas;
    const ConvexPolygon polygons[] = {all.polygon(0)};
    TierCounts counts;
    areas.unoccluded = exact_area(boundary_of_union(polygons, counts));
    if (!is_hidden) areas.visible = visible_parts(std::move(all), areas.unoccluded);
    if (are_same) {
      areas.in_object = areas.visible;
    } else if (!is_hidden_in_object) {
      areas.in_object = visible_parts(std::move(in_object), areas.unoccluded);
    }
    return areas;
  }

 private:
  /// The parts of the first piece that the others leave.
  static std::vector<Ratio> visible_parts(CellVisibility pieces, const Ratio& unoccluded) {
    if (pieces.size() == 1) return {unoccluded};
    const SurfaceRegion& surface = pieces.surface(0);
    std::vector<Ratio> parts;
    divide(std::move(pieces), [&](CellVisibility& part) {
      for (std::size_t piece = 0; piece < part.size(); ++piece) {
        if (&part.surface(piece) != &surface) continue;
        const Boundary boundary = part.visible(piece);
        if (!boundary.empty()) parts.push_back(exact_area(boundary));
      }
    });
    return parts;
  }

  TriangleSource triangles_;
  SceneSurfaces surfaces_;
};

struct ObjectSums {
  EnclosedSum visible, in_object;
};

VisibleArea rounded(const ExactAreas& areas) {
  constexpr std::size_t few = 4;
  if (areas.visible.size() > few) {
    const Enclosure alone{areas.unoccluded, areas.unoccluded};
    if (const auto area = settled(enclosed_sum(areas.visible).get(), alone)) return *area;
  }
  return rounded(sum_of(areas.visible), areas.unoccluded);
}

/// Rounds the exact areas of an object, where their enclosures do not settle how they round.
VisibleArea rounded_exactly(const SceneAreas& areas, std::uint32_t object) {
  std::vector<Ratio> visible, in_object;
  for (std::uint32_t number = 0; number < areas.count(); ++number) {
    check_interruption();
    if (areas.object_of(number) != object) continue;
    const ExactAreas exact = areas.of(number);
    visible.insert(visible.end(), exact.visible.begin(), exact.visible.end());
    in_object.insert(in_object.end(), exact.in_object.begin(), exact.in_object.end());
  }
  return rounded(sum_of(std::move(visible)), sum_of(std::move(in_object)));
}

VisibleArea rounded(const SceneAreas& areas, const ObjectSums& sums, std::uint32_t object) {
  const Enclosure visible = sums.visible.get(), alone = sums.in_object.get();
  if (alone.high.sign() == Sign::zero) return {};
  if (const auto area = settled(visible, alone)) return *area;
  return rounded_exactly(areas, object);
}

VisibleAreas areas_in_arena(const CoverageFrame& frame,
                            const std::function<void(double)>& progress) {
  constexpr std::uint32_t chunk = 64;
  const std::uint32_t chunks = frame.triangles.count() / chunk + 1;
  Progress done(progress, SceneSurfaces::parts(frame.triangles.count()) + chunks);
  const SceneAreas areas(frame, done);
  const std::size_t objects = frame.triangles.objects().size();
  VisibleAreas result;
  result.triangles.resize(areas.count());
  PerThread<std::vector<ObjectSums>> parts([&] { return std::vector<ObjectSums>(objects); });
  parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t k) {
    const std::uint32_t end = std::min(areas.count(), (k + 1) * chunk);
    for (std::uint32_t number = k * chunk; number < end; ++number) {
      const ExactAreas exact = areas.of(number);
      result.triangles[number] = rounded(exact);
      ObjectSums& sums = parts.local()[areas.object_of(number)];
      sums.visible.add(enclosed_sum(exact.visible));
      sums.in_object.add(enclosed_sum(exact.in_object));
    }
    done.part_done();
  });
  std::vector<ObjectSums> sums(objects);
  parts.for_each([&](const std::vector<ObjectSums>& part) {
    for (std::size_t object = 0; object < objects; ++object) {
      sums[object].visible.add(part[object].visible);
      sums[object].in_object.add(part[object].in_object);
    }
  });
  for (std::uint32_t object = 0; object < objects; ++object) {
    result.objects.push_back(rounded(areas, sums[object], object));
  }
  return result;
}

}  // namespace

VisibleAreas reference_areas(const TriangleSource& triangles, const Camera& camera,
                             const RenderOptions& options,
                             const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  return with_threads(options.threads, [&] {
    require_renderable(triangles, camera);
    return areas_in_arena({triangles, camera, options.cull}, progress);
  });
}

}  // namespace fathom
