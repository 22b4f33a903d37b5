#include "tests/area/pairwise_areas.h"

#include "fathom/area/cell_coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/visible_fragments.h"
#include "fathom/numeric/rounding.h"

namespace fathom::checks {
using namespace area;

namespace {

class SceneByPairs {
 public:
  SceneByPairs(const CoverageFrame& frame, Progress& progress)
      : triangles_(frame.triangles), surfaces_(frame, progress) {}

  [[nodiscard]] std::uint32_t count() const { return surfaces_.count(); }
  [[nodiscard]] std::uint32_t object_of(std::uint32_t number) const {
    return triangles_.origin(number).object;
  }

  /// Everything happens within the box of the triangle.
  [[nodiscard]] PairwiseAreas of(std::uint32_t number) const {
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
    PairwiseAreas areas;
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

VisibleArea rounded(const Ratio& visible, const Ratio& unoccluded) {
  VisibleArea area{round_to_binary64(visible), round_to_binary64(unoccluded), std::nullopt};
  if (unoccluded.sign() != Sign::zero) {
    area.ratio = round_to_binary64(quotient(visible, unoccluded));
  }
  return area;
}

}  // namespace

std::vector<PairwiseAreas> pairwise_areas(const CoverageFrame& frame) {
  const std::function<void(double)> no_report;
  Progress progress(no_report, 1);
  const SceneByPairs scene(frame, progress);
  std::vector<PairwiseAreas> areas;
  for (std::uint32_t number = 0; number < scene.count(); ++number)
    areas.push_back(scene.of(number));
  return areas;
}

VisibleAreas rounded_pairwise_areas(const Scene& scene, const Camera& camera, Cull cull) {
  const TriangleSource triangles(scene);
  const std::vector<PairwiseAreas> areas = pairwise_areas({triangles, camera, cull});
  VisibleAreas result;
  std::vector<PairwiseAreas> objects(scene.objects.size());
  for (std::uint32_t number = 0; number < areas.size(); ++number) {
    const PairwiseAreas& its = areas[number];
    result.triangles.push_back(rounded(sum_of(its.visible), its.unoccluded));
    PairwiseAreas& object = objects[triangles.origin(number).object];
    object.visible.insert(object.visible.end(), its.visible.begin(), its.visible.end());
    object.in_object.insert(object.in_object.end(), its.in_object.begin(), its.in_object.end());
  }
  for (const PairwiseAreas& object : objects) {
    result.objects.push_back(rounded(sum_of(object.visible), sum_of(object.in_object)));
  }
  return result;
}

}  // namespace fathom::checks
