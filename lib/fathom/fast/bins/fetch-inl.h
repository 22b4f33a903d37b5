// Triangles of a tile, read in time. Included once for every kind of vector instructions, by the
// files that foreach_target.h compiles for each.
#if defined(FATHOM_FAST_FETCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_FETCH_INL_H
#undef FATHOM_FAST_FETCH_INL_H
#else
#define FATHOM_FAST_FETCH_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/setup/setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// As many triangles as there are lanes of binary64 (the last one repeated if there are fewer).
struct Triangles {
  std::array<std::uint32_t, SetupBatch::most> number;  // in the scene
  std::array<CornerIndices, SetupBatch::most> corners;
};

/// Reads the triangles from `first` on and prefetches the following ones: triangles of a tile may
/// be anywhere in the mesh.
HWY_INLINE void fetch(const ImageObject& object, std::span<const std::uint32_t> numbers,
                      std::size_t first, Triangles& next) {
  const std::size_t lanes = hn::Lanes(D());
  const CornerIndices* triangles = object.mesh.triangles.data();
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t i = std::min(first + k, numbers.size() - 1);
    const std::size_t later = std::min(i + 2 * lanes, numbers.size() - 1);
    hwy::Prefetch(triangles + (numbers[later] - object.first_number));
    next.number[k] = object.number_in_scene(numbers[i]);
    next.corners[k] = triangles[numbers[i] - object.first_number];
    for (const std::uint32_t vertex : next.corners[k]) hwy::Prefetch(&object.vertices[vertex]);
  }
}

/// Calls visit(triangles, first, count) for as many at once as there are lanes: `count` of them,
/// which begin with numbers[first]. The next ones are read meanwhile.
template <class Visit>
HWY_INLINE void for_each_triangles(const ImageObject& object,
                                   std::span<const std::uint32_t> numbers, const Visit& visit) {
  const std::size_t lanes = hn::Lanes(D());
  Triangles next{};
  fetch(object, numbers, 0, next);
  for (std::size_t first = 0; first < numbers.size(); first += lanes) {
    const Triangles now = next;
    fetch(object, numbers, first + lanes, next);
    visit(now, first, std::min(lanes, numbers.size() - first));
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
