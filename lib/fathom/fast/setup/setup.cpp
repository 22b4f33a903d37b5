#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fathom/fast/setup/setup.cpp"
#include "fathom/fast/setup/setup.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "fathom/fast/setup/setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

void set_up_batch(const ImageVertex* vertices, const CornerIndices* triangles, std::size_t count,
                  const PixelBox& area, const DepthRange& range, SetupBatch& batch) {
  // There may be fewer lanes than a batch has: the parts are put together.
  const std::size_t lanes = hn::Lanes(D());
  CornerIndices corners[SetupBatch::most];
  for (std::size_t i = 0; i < SetupBatch::most; ++i) corners[i] = triangles[std::min(i, count - 1)];
  unsigned empty = 0, refused = 0, test_range = 0, snapped = 0;
  for (std::size_t first = 0; first < SetupBatch::most; first += lanes) {
    SetupBatch part;
    set_up_lanes(vertices, corners + first, area, range, part);
    empty |= part.empty << first;
    refused |= part.refused << first;
    test_range |= part.test_range << first;
    snapped |= part.snapped << first;
    for (std::size_t k = 0; k < lanes; ++k) batch.set(first + k, part.get(k), part.box(k));
  }
  batch.empty = empty;
  batch.refused = refused;
  batch.test_range = test_range;
  batch.snapped = snapped;
}

void orient(const ImageVertex* vertices, const CornerIndices& triangle, int& sign, bool& certain) {
  CornerIndices corners[SetupBatch::most];
  std::fill(std::begin(corners), std::end(corners), triangle);
  const Orientation o = certified_orientation(load_corners(vertices, corners));
  const bool positive = bits_of(o.positive) & 1, negative = bits_of(o.negative) & 1;
  sign = positive ? 1 : negative ? -1 : 0;
  certain = positive || negative || (bits_of(o.zero) & 1);
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fathom::fast {
using namespace triangle;

HWY_EXPORT(set_up_batch);
HWY_EXPORT(orient);
HWY_EXPORT(target_name);

const char* vector_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void certified_setups(const ImageVertex* vertices, const CornerIndices* triangles,
                      std::size_t count, const PixelBox& area, const DepthRange& range,
                      SetupBatch& batch) {
  HWY_DYNAMIC_DISPATCH(set_up_batch)(vertices, triangles, count, area, range, batch);
}

std::optional<Sign> certified_orientation(const ImageVertex* vertices,
                                          const CornerIndices& triangle) {
  int sign = 0;
  bool certain = false;
  HWY_DYNAMIC_DISPATCH(orient)(vertices, triangle, sign, certain);
  if (!certain) return std::nullopt;
  return sign > 0 ? Sign::positive : sign < 0 ? Sign::negative : Sign::zero;
}

PixelBox SetupBatch::box(std::size_t lane) const {
  if (first_column[lane] > last_column[lane] || first_row[lane] > last_row[lane]) return {};
  const auto whole = [&](const Numbers& numbers) {
    return static_cast<std::uint32_t>(numbers[lane]);
  };
  return {whole(first_column), whole(last_column), whole(first_row), whole(last_row)};
}

TriangleSetup SetupBatch::get(std::size_t lane) const {
  TriangleSetup setup;
  setup.number = number[lane];
  setup.column = box(lane).first_column;
  setup.row = box(lane).first_row;
  for (std::size_t i = 0; i < 3; ++i) {
    setup.edge_a[i] = edge_a[i][lane];
    setup.edge_b[i] = edge_b[i][lane];
    setup.edge_c[i] = edge_c[i][lane];
  }
  setup.edge_error = edge_error[lane];
  setup.q_a = q_a[lane];
  setup.q_b = q_b[lane];
  setup.q_c = q_c[lane];
  setup.q_error = q_error[lane];
  return setup;
}

void SetupBatch::set(std::size_t lane, const TriangleSetup& setup, const PixelBox& box) {
  number[lane] = setup.number;
  for (std::size_t i = 0; i < 3; ++i) {
    edge_a[i][lane] = setup.edge_a[i];
    edge_b[i][lane] = setup.edge_b[i];
    edge_c[i][lane] = setup.edge_c[i];
  }
  edge_error[lane] = setup.edge_error;
  q_a[lane] = setup.q_a;
  q_b[lane] = setup.q_b;
  q_c[lane] = setup.q_c;
  q_error[lane] = setup.q_error;
  first_column[lane] = box.first_column;
  last_column[lane] = box.last_column;
  first_row[lane] = box.first_row;
  last_row[lane] = box.last_row;
}

}  // namespace fathom::fast
#endif
