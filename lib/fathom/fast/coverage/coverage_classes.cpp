// Which triangles are simple for channel A, several at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/coverage/coverage_classes.cpp"
#include "fathom/fast/coverage/coverage_classes.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "fathom/fast/bins/fetch-inl.h"
#include "fathom/fast/setup/setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// Whether no depth of the triangles counts: q of a point lies between the q of the corners.
HWY_INLINE M certainly_miss(const DepthRange& range, const Corners& t) {
  const V error = hn::Add(t.q_error, t.q_error);
  const V least = hn::Sub(least_of(t.A.q, t.B.q, t.C.q), error);
  const V greatest = hn::Add(greatest_of(t.A.q, t.B.q, t.C.q), error);
  return hn::Or(hn::Lt(greatest, constant(range.outside_least)),
                hn::Gt(least, constant(range.outside_greatest)));
}

void classify(const ImageObject& object, std::span<const std::uint32_t> numbers,
              const DepthRange& range, const PixelBox& tile, CoverageTriangle* classes) {
  for_each_triangles(
      object, numbers, [&](const Triangles& now, std::size_t first, std::size_t count) HWY_ATTR {
        const Corners t = load_corners(object.vertices.get(), now.corners.data());
        const M usable = are_usable(t);
        const Orientation o = certified_orientation(t);
        const M simple = hn::AndNot(may_leave(range, t), usable);
        const unsigned positive = bits_of(hn::And(simple, o.positive));
        const unsigned negative = bits_of(hn::And(simple, o.negative));
        const unsigned nothing = bits_of(hn::And(usable, hn::Or(o.zero, certainly_miss(range, t))));
        // Computed coordinates will do: this affects only the time.
        const V width = hn::Sub(greatest_of(t.A.u, t.B.u, t.C.u), least_of(t.A.u, t.B.u, t.C.u));
        const V height = hn::Sub(greatest_of(t.A.v, t.B.v, t.C.v), least_of(t.A.v, t.B.v, t.C.v));
        const unsigned large = bits_of(hn::Gt(hn::Min(width, height), constant(16)));
        const Boxes box = area_boxes(t, tile);
        const M met = hn::AndNot(are_empty(box), usable);
        alignas(64) std::int64_t left[8], right[8], top[8], bottom[8];
        const auto store_local = [&](V x, std::uint32_t origin, std::int64_t* to) HWY_ATTR {
          hn::Store(hn::ConvertTo(DI(), hn::IfThenElseZero(met, hn::Sub(x, constant(origin)))),
                    DI(), to);
        };
        store_local(box.first_column, tile.first_column, left);
        store_local(box.last_column, tile.first_column, right);
        store_local(box.first_row, tile.first_row, top);
        store_local(box.last_row, tile.first_row, bottom);
        const unsigned is_met = bits_of(met);
        for (std::size_t k = 0; k < count; ++k) {
          const CoverageClass kind = nothing >> k & 1    ? CoverageClass::nothing
                                     : positive >> k & 1 ? CoverageClass::positive
                                     : negative >> k & 1 ? CoverageClass::negative
                                                         : CoverageClass::open;
          const bool simple_one =
              kind == CoverageClass::positive || kind == CoverageClass::negative;
          const auto small = [](std::int64_t x) { return static_cast<std::int16_t>(x); };
          classes[first + k] = {kind, simple_one && (large >> k & 1),
                                is_met >> k & 1 ? TileBox{small(left[k]), small(right[k]),
                                                          small(top[k]), small(bottom[k])}
                                                : TileBox{1, 0, 1, 0}};
        }
      });
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(classify);

void classify_for_coverage(const ImageObject& object, std::span<const std::uint32_t> numbers,
                           const DepthRange& range, const PixelBox& tile,
                           CoverageTriangle* classes) {
  HWY_DYNAMIC_DISPATCH(classify)(object, numbers, range, tile, classes);
}

}  // namespace fathom::fast
#endif
