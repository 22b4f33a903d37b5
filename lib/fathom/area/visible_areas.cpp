#include "fathom/area/visible_areas.h"

#include <numeric>
#include <span>

#include "fathom/area/plane/plane_areas.h"
#include "fathom/numeric/real.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;

namespace {

constexpr std::uint32_t chunk = 64;
/// Unoccluded areas are quick: so many chunks are one part of the progress.
constexpr std::uint32_t chunks_per_report = 64;

EnclosedSum enclosed_sum(const Terms& terms) {
  EnclosedSum sum;
  for (const Ratio& term : terms) sum.add(term);
  return sum;
}

VisibleArea rounded(const Ratio& visible, const Ratio& unoccluded) {
  VisibleArea area{round_to_binary64(visible), round_to_binary64(unoccluded), std::nullopt};
  if (unoccluded.sign() != Sign::zero) {
    area.ratio = round_to_binary64(quotient(visible, unoccluded));
  }
  return area;
}

/// The areas and their ratio, if enclosures settle how they round.
std::optional<VisibleArea> settled(const Enclosure& visible, const Enclosure& alone) {
  if (alone.low.sign() == Sign::zero) return std::nullopt;
  const VisibleArea low = rounded(visible.low, alone.low), high = rounded(visible.high, alone.high);
  const double least = round_to_binary64(quotient(visible.low, alone.high));
  const double greatest = round_to_binary64(quotient(visible.high, alone.low));
  const bool settled =
      low.visible == high.visible && low.unoccluded == high.unoccluded && least == greatest;
  if (!settled) return std::nullopt;
  return VisibleArea{low.visible, low.unoccluded, least};
}

/// Numbers of the triangles of an object, or of all.
std::vector<std::uint32_t> numbers_from(std::uint32_t first, std::uint32_t end) {
  std::vector<std::uint32_t> numbers(end - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// The visible part of some triangles of a scene, with all others removed.
class VisiblePart {
 public:
  VisiblePart(const ProjectedScene& scene, std::uint32_t first, std::uint32_t end,
              const std::function<void()>& part_done)
      : scene_(scene),
        mesh_(scene, numbers_from(first, end)),
        areas_(mesh_, {.image = true}, part_done) {}

  /// Calls visit(number, visibility, terms) for triangles that are not hidden, among some of the
  /// mesh.
  template <class Visit>
  void visit(std::uint32_t first, std::uint32_t end, const Visit& visit) const {
    for (std::uint32_t i = first; i < end; ++i) {
      if (areas_.visibility(i) == Visibility::hidden) continue;
      visit(mesh_.number(i), areas_.visibility(i), areas_.terms(i).image);
    }
  }
  [[nodiscard]] std::uint32_t size() const { return mesh_.size(); }

  /// Adds the terms of each triangle to the sum of its object.
  [[nodiscard]] std::vector<EnclosedSum> sums(const TriangleSource& triangles) const {
    PerThread<std::vector<EnclosedSum>> parts(
        [&] { return std::vector<EnclosedSum>(triangles.objects().size()); });
    in_parallel(size() / chunk + 1, [&](std::size_t k) {
      std::vector<EnclosedSum>& sums = parts.local();
      const auto first = static_cast<std::uint32_t>(k * chunk);
      visit(first, std::min(size(), first + chunk), [&](auto number, auto visibility, auto& terms) {
        EnclosedSum& sum = sums[triangles.origin(number).object];
        if (visibility == Visibility::whole) sum.add(scene_.own_area(number));
        for (const Ratio& term : terms) sum.add(term);
      });
    });
    std::vector<EnclosedSum> all(triangles.objects().size());
    parts.for_each([&](const std::vector<EnclosedSum>& part) {
      for (std::size_t k = 0; k < all.size(); ++k) all[k].add(part[k]);
    });
    return all;
  }

  /// The exact area of the visible part of an object.
  [[nodiscard]] Ratio exact_area(const TriangleSource& triangles, std::uint32_t object) const {
    Terms all;
    visit(0, size(), [&](auto number, auto visibility, auto& terms) {
      check_interruption();
      if (triangles.origin(number).object != object) return;
      if (visibility == Visibility::whole) all.push_back(scene_.own_area(number));
      all.insert(all.end(), terms.begin(), terms.end());
    });
    return sum_of(std::move(all));
  }

 private:
  const ProjectedScene& scene_;
  PlaneMesh mesh_;
  PlaneAreas areas_;
};

class SceneAreas {
 public:
  SceneAreas(const CoverageFrame& frame, const std::function<void(double)>& progress)
      : triangles_(frame.triangles),
        done_(progress, parts(frame.triangles)),
        scene_(frame, done_),
        all_(scene_, 0, scene_.count(), [&] { done_.part_done(); }) {}

  VisibleAreas areas() {
    VisibleAreas result;
    result.triangles.resize(scene_.count());
    add_unoccluded(result);
    add_visible(result);
    add_objects(result);
    return result;
  }

 private:
  static std::uint64_t parts(const TriangleSource& triangles) {
    const std::uint64_t runs = triangles.objects().size() > 1 ? triangles.objects().size() + 1 : 1;
    return ProjectedScene::parts(triangles) + runs * PlaneAreas::parts +
           triangles.count() / chunk / chunks_per_report + 1;
  }

  void add_unoccluded(VisibleAreas& result) {
    in_parallel(scene_.count() / chunk + 1, [&](std::size_t k) {
      check_interruption();
      const auto first = static_cast<std::uint32_t>(k * chunk);
      for (std::uint32_t number = first; number < std::min(scene_.count(), first + chunk);
           ++number) {
        result.triangles[number] = rounded(Ratio(), unoccluded_area(scene_, number));
      }
      if (k % chunks_per_report == 0) done_.part_done();
    });
  }

  void add_visible(VisibleAreas& result) const {
    in_parallel(all_.size() / chunk + 1, [&](std::size_t k) {
      check_interruption();
      const auto first = static_cast<std::uint32_t>(k * chunk);
      all_.visit(first, std::min(all_.size(), first + chunk),
                 [&](auto number, auto visibility, auto& terms) {
                   VisibleArea& area = result.triangles[number];
                   if (visibility == Visibility::whole) {
                     area.visible = area.unoccluded;
                     area.ratio = 1;
                   } else {
                     area = area_of(terms, unoccluded_area(scene_, number));
                   }
                 });
    });
  }

  static VisibleArea area_of(const Terms& terms, const Ratio& alone) {
    constexpr std::size_t few = 4;
    if (terms.size() > few) {
      if (const auto area = settled(enclosed_sum(terms).get(), {alone, alone})) return *area;
    }
    return rounded(sum_of(terms), alone);
  }

  void add_objects(VisibleAreas& result) {
    const std::vector<EnclosedSum> visible = all_.sums(triangles_);
    const auto objects = static_cast<std::uint32_t>(triangles_.objects().size());
    std::uint32_t first = 0;
    for (std::uint32_t object = 0; object < objects; ++object) {
      const std::uint32_t end = end_of(object, first);
      result.objects.push_back(area_of(object, first, end, visible));
      first = end;
    }
  }

  /// The end of the numbers of an object's triangles, which begin at `first`.
  [[nodiscard]] std::uint32_t end_of(std::uint32_t object, std::uint32_t first) const {
    std::uint32_t low = first, high = scene_.count();
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (triangles_.origin(middle).object > object) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }

  VisibleArea area_of(std::uint32_t object, std::uint32_t first, std::uint32_t end,
                      const std::vector<EnclosedSum>& visible) {
    const bool is_all = triangles_.objects().size() == 1;
    std::optional<VisiblePart> its;
    if (!is_all) its.emplace(scene_, first, end, [&] { done_.part_done(); });
    const VisiblePart& alone = is_all ? all_ : *its;
    const Enclosure of_visible = visible[object].get(),
                    of_alone = is_all ? of_visible : alone.sums(triangles_)[object].get();
    if (of_alone.high.sign() == Sign::zero) return {};
    if (const auto area = settled(of_visible, of_alone)) return *area;
    return rounded(all_.exact_area(triangles_, object), alone.exact_area(triangles_, object));
  }

  const TriangleSource& triangles_;
  Progress done_;
  ProjectedScene scene_;
  VisiblePart all_;
};

}  // namespace

VisibleAreas visible_areas(const TriangleSource& triangles, const Camera& camera,
                           const RenderOptions& options,
                           const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  return with_threads(options.threads, [&] {
    require_renderable(triangles, camera);
    const CoverageFrame frame{triangles, camera, options.cull};
    return SceneAreas(frame, progress).areas();
  });
}

}  // namespace fathom
