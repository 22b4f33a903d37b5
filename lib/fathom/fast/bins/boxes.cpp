// Which pixels triangles can cover, several triangles at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/bins/boxes.cpp"
#include "fathom/fast/bins/boxes.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "fathom/fast/bins/nearness-inl.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lanes/each_bit.h"
#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/fast/setup/setup-inl.h"
#include "fathom/scene/element_checks.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// Whether the triangles certainly cover no sample of their boxes: an edge function is certainly
/// negative at the corner where it is greatest, and so everywhere in the box.
/// Needs    a certain orientation, or else edge functions may have the wrong sign.
HWY_INLINE M certainly_miss(const Corners& t, const Boxes& box) {
  const LocalTriangles l = localise(t, box);
  Edges e = certified_edges(l);
  use_top_left_rule(have_exact_edges(t, l), e);
  const V right = hn::Sub(box.last_column, box.first_column);
  const V bottom = hn::Sub(box.last_row, box.first_row);
  V least = constant(0);
  for (int i = 0; i < 3; ++i) {
    const V x = hn::IfThenElseZero(hn::Gt(e.a[i], constant(0)), right);
    const V y = hn::IfThenElseZero(hn::Gt(e.b[i], constant(0)), bottom);
    least = hn::Min(least, hn::MulAdd(e.b[i], y, hn::MulAdd(e.a[i], x, e.c[i])));
  }
  return hn::Lt(least, hn::Neg(e.error));
}

HWY_INLINE V tile_of(V pixel) {
  return hn::Floor(hn::Mul(pixel, constant(1.0 / TileShape::size)));
}

struct Sorted {
  M one_tile, more_tiles, unsettled;
  M front;
  V tile;
  Boxes box;
  /// In the lower halves: the greatest q moved_up_in_24_bits(); Nearness of those in one tile.
  hn::Vec<DU> nearest, nearness;
};

// A covered sample's q lies between those of the corners, and that of a corner, moved by twice its
// bound, beyond the exact one (moved_q.gappa.in: no bound of a usable corner's q is below u│q│).
// Rounding to binary32 takes less from it than moving it up by a 256th part more adds.
HWY_INLINE hn::Vec<DU> nearest_of(const Corners& t) {
  return moved_up_in_24_bits(
      hn::MulAdd(constant(setup_bounds::q_moves), t.q_error, greatest_of(t.A.q, t.B.q, t.C.q)));
}

HWY_INLINE Sorted sort_lanes(const BoxRequest& r, const CornerIndices* triangles, M valid,
                             BoxBatch& out) {
  const D d;
  const Corners t = load_corners(r.vertices, triangles);
  const Orientation o = certified_orientation(t);
  const M usable = hn::And(valid, are_usable(t));
  const M positive = hn::And(usable, o.positive), negative = hn::And(usable, o.negative);
  const M zero = hn::And(usable, o.zero);
  const M with_area = hn::Or(positive, negative);
  const M kept = r.cull == Cull::none ? with_area : r.cull == Cull::back ? negative : positive;

  Sorted s;
  s.front = o.negative;
  s.unsettled = hn::AndNot(hn::Or(with_area, zero), valid);
  const PixelBox image{0, r.image_width - 1, 0, r.image_height - 1};
  s.box = sample_boxes(t, image);
  const M without_samples = hn::Or(are_empty(s.box), certainly_miss(t, s.box));
  if (r.by_area) s.box = area_boxes(t, image);
  const M visible = hn::AndNot(r.by_area ? are_empty(s.box) : without_samples, kept);
  const V column = tile_of(s.box.first_column), row = tile_of(s.box.first_row);
  const M together =
      hn::And(hn::Eq(column, tile_of(s.box.last_column)), hn::Eq(row, tile_of(s.box.last_row)));
  s.one_tile = hn::And(visible, together);
  s.more_tiles = hn::AndNot(together, visible);
  s.tile = hn::MulAdd(row, constant(r.tile_columns), column);
  s.nearest = nearest_of(t);
  if (r.by_area) {
    const DU du;
    const auto flag = hn::Set(du, std::uint64_t{nearness_without_samples});
    s.nearest = hn::Or(s.nearest, hn::IfThenElseZero(hn::RebindMask(du, without_samples), flag));
  }
  s.nearness = nearness_in(s.nearest, s.box, column, row);
  out.degenerate += hn::CountTrue(d, zero);
  out.culled += hn::CountTrue(d, hn::AndNot(kept, with_area));
  return s;
}

HWY_INLINE void append(const Sorted& s, std::uint32_t first_number, BoxBatch& out) {
  const D d;
  const DU du;
  const auto number = counting_lanes(du, std::uint64_t{first_number});
  const auto tile = hn::BitCast(du, hn::ConvertTo(DI(), s.tile));
  const auto entry = hn::Or(hn::ShiftLeft<32>(tile), number);
  const auto store = [&](M mask, BoxBatch::Entries& entries) HWY_ATTR {
    const auto which = hn::RebindMask(du, mask);
    hn::CompressStore(s.nearness, which, du, entries.nearness.data() + entries.count);
    entries.count += hn::CompressStore(entry, which, du, entries.entries.data() + entries.count);
  };
  store(hn::And(s.one_tile, s.front), out.in_one_tile[static_cast<std::size_t>(Side::front)]);
  store(hn::AndNot(s.front, s.one_tile), out.in_one_tile[static_cast<std::size_t>(Side::back)]);
  if (HWY_UNLIKELY(!hn::AllFalse(d, s.more_tiles))) {
    alignas(64) double left[8], right[8], top[8], bottom[8];
    hn::Store(s.box.first_column, d, left);
    hn::Store(s.box.last_column, d, right);
    hn::Store(s.box.first_row, d, top);
    hn::Store(s.box.last_row, d, bottom);
    alignas(64) std::uint64_t nearest[8];
    hn::Store(s.nearest, du, nearest);
    const unsigned front = bits_of(s.front);
    for (const std::size_t k : EachBit(bits_of(s.more_tiles))) {
      out.number[out.in_more_tiles] = first_number + static_cast<std::uint32_t>(k);
      out.nearest[out.in_more_tiles] = static_cast<std::uint32_t>(nearest[k]);
      out.side[out.in_more_tiles] = front >> k & 1 ? Side::front : Side::back;
      out.box[out.in_more_tiles++] = {
          static_cast<std::uint32_t>(left[k]), static_cast<std::uint32_t>(right[k]),
          static_cast<std::uint32_t>(top[k]), static_cast<std::uint32_t>(bottom[k])};
    }
  }
  if (HWY_UNLIKELY(!hn::AllFalse(d, s.unsettled))) {
    for (const std::size_t k : EachBit(bits_of(s.unsettled))) {
      out.unsettled_number[out.unsettled++] = first_number + static_cast<std::uint32_t>(k);
    }
  }
}

/// Whether all corners of as many triangles as there are lanes are vertices. Checked here, where
/// they are read anyway, because a separate pass takes a twentieth of the time of a map.
HWY_INLINE bool are_vertices(const CornerIndices* triangles, std::uint32_t end) {
  const hn::Rebind<std::uint32_t, D> d;
  const std::uint32_t* indices = triangles->data();
  const auto a = hn::LoadU(d, indices), b = hn::LoadU(d, indices + hn::Lanes(d)),
             c = hn::LoadU(d, indices + 2 * hn::Lanes(d));
  return hn::AllTrue(d, hn::Lt(hn::Max(hn::Max(a, b), c), hn::Set(d, end)));
}

/// Returns false if a corner is not a vertex.
bool sort_triangles(const BoxRequest& r, BoxBatch& out) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < r.count; i += lanes) {
    const std::size_t count = std::min(lanes, r.count - i);
    const CornerIndices* triangles = r.triangles + i;
    CornerIndices last[8];
    if (count < lanes) {
      std::fill(std::begin(last), std::end(last), r.triangles[i]);
      std::copy_n(r.triangles + i, count, last);
      triangles = last;
    }
    if (HWY_UNLIKELY(!are_vertices(triangles, r.vertex_count))) return false;
    const M valid = hn::FirstN(d, count);
    append(sort_lanes(r, triangles, valid, out), r.first_number + static_cast<std::uint32_t>(i),
           out);
  }
  return true;
}

/// The edge functions of at most as many triangles of the batch as there are lanes, by their
/// places. All lanes are computed; unused lanes repeat the first triangle.
HWY_INLINE void put_edges_at(const BoxRequest& r, const std::size_t* places, std::size_t count,
                             BoxBatch& out) {
  CornerIndices corners[8];
  alignas(64) double left[8], right[8], top[8], bottom[8];
  for (std::size_t k = 0; k < hn::Lanes(D()); ++k) {
    const std::size_t place = places[k < count ? k : 0];
    const PixelBox& box = out.box[place];
    corners[k] = r.triangles[out.number[place] - r.first_number];
    left[k] = box.first_column;
    right[k] = box.last_column;
    top[k] = box.first_row;
    bottom[k] = box.last_row;
  }
  const D d;
  const Boxes box{hn::Load(d, left), hn::Load(d, right), hn::Load(d, top), hn::Load(d, bottom)};
  const Edges e = certified_edges(localise(load_corners(r.vertices, corners), box));
  alignas(64) double a[3][8] = {}, b[3][8] = {}, c[3][8] = {}, error[8] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    hn::Store(e.a[i], d, a[i]);
    hn::Store(e.b[i], d, b[i]);
    hn::Store(e.c[i], d, c[i]);
  }
  hn::Store(e.error, d, error);
  for (std::size_t k = 0; k < count; ++k) {
    out.edges.push_back({{a[0][k], a[1][k], a[2][k]},
                         {b[0][k], b[1][k], b[2][k]},
                         {c[0][k], c[1][k], c[2][k]},
                         error[k]});
  }
}

/// The edge functions of the triangles whose boxes meet many tiles, whose orientation is certain.
void put_edges(const BoxRequest& r, BoxBatch& out) {
  out.edges.clear();
  std::size_t places[8], count = 0;
  for (std::size_t i = 0; i < out.in_more_tiles; ++i) {
    if (!meets_many_tiles(out.box[i], TileShape::size)) continue;
    places[count++] = i;
    if (count < hn::Lanes(D())) continue;
    put_edges_at(r, places, count, out);
    count = 0;
  }
  if (count != 0) put_edges_at(r, places, count, out);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(sort_triangles);
HWY_EXPORT(put_edges);

void box_triangles(const BoxRequest& request, BoxBatch& boxes) {
  for (BoxBatch::Entries& entries : boxes.in_one_tile) entries.count = 0;
  boxes.in_more_tiles = boxes.unsettled = 0;
  boxes.degenerate = boxes.culled = 0;
  if (!HWY_DYNAMIC_DISPATCH(sort_triangles)(request, boxes)) throw scene::ElementFault();
  if (boxes.in_more_tiles != 0) HWY_DYNAMIC_DISPATCH(put_edges)(request, boxes);
}

}  // namespace fathom::fast
#endif
