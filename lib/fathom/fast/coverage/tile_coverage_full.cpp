#include <algorithm>
#include <bit>
#include <limits>

#include "fathom/fast/coverage/tile_coverage.h"
#include "fathom/fast/coverage/tile_functions.h"

// The triangles of a tile, which pixels may be covered in part, and which are covered wholly.
namespace fathom::fast {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

template <class Visit>
void TileCoverage::for_each_object(std::span<const std::uint32_t> numbers,
                                   const Visit& visit) const {
  for (std::size_t first = 0; first < numbers.size();) {
    const ImageObject& object = object_of(scene_.objects, numbers[first]);
    std::size_t end = first;
    while (end < numbers.size() && numbers[end] >= object.first_number &&
           numbers[end] < object.end_number()) {
      ++end;
    }
    visit(object, first, end);
    first = end;
  }
}

bool TileCoverage::find_open_pixels(std::uint32_t tile_number, const DrawContext& context) {
  numbers_.clear();
  classes_.clear();
  doubtful_.clear();
  open_shapes_.clear();
  outlines_.start(area_);
  full_.fill(0);
  open_.fill(~std::uint64_t{0});
  const std::size_t front = add_triangles(Side::front, tile_number, context);
  if (fill_large(front)) return false;
  add_edges(front);
  if (look_at_front()) return false;
  const std::size_t back = add_triangles(Side::back, tile_number, context);
  add_edges(back);
  mark_open();
  find_boxes(context);
  if (fill_large(front)) return false;
  for (std::size_t row = 0; row < size; ++row) open_[row] &= ~full_[row];
  return true;
}

// Triangles are grouped by object. For most triangles the bins show that their corners are usable
// and their orientation is certain, and how near they can be.
std::size_t TileCoverage::add_triangles(Side side, std::uint32_t tile_number,
                                        const DrawContext& context) {
  const std::size_t begin = numbers_.size();
  const CoverageClass kind =
      side == Side::front ? CoverageClass::negative : CoverageClass::positive;
  const double nearest =
      context.range.inside_least == -infinity ? context.range.inside_greatest : -infinity;
  const std::size_t first_doubtful = doubtful_.size();
  for (const Bins& bins : scene_.bins) {
    for (const TileEntry& entry : bins.in_tile(tile_number, side)) {
      const bool is_in_range = std::bit_cast<float>(entry.nearness & nearness_of_q) <= nearest;
      if (!is_in_range) doubtful_.push_back(numbers_.size());
      numbers_.push_back(entry.number);
    }
  }
  classes_.resize(numbers_.size(), {kind, false, {}});
  classify(std::span(doubtful_).subspan(first_doubtful), context,
           [](CoverageTriangle& old, const CoverageTriangle& found) { old = found; });
  look_at_open(begin, context);
  return begin;
}

// Most tiles do not need these boxes. The boxes of doubtful triangles are known.
void TileCoverage::find_boxes(const DrawContext& context) {
  std::vector<std::size_t>& others = without_box_;
  others.clear();
  auto next = doubtful_.begin();
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (next != doubtful_.end() && *next == i) {
      ++next;
    } else {
      others.push_back(i);
    }
  }
  classify(others, context, [](CoverageTriangle& triangle, const CoverageTriangle& found) {
    triangle.is_large = found.is_large;
    triangle.box = found.box;
  });
}

template <class Take>
void TileCoverage::classify(std::span<const std::size_t> which, const DrawContext& context,
                            const Take& take) {
  std::vector<std::uint32_t>& numbers = numbers_to_classify_;
  numbers.clear();
  for (const std::size_t i : which) numbers.push_back(numbers_[i]);
  std::vector<CoverageTriangle>& classes = classes_found_;
  classes.resize(numbers.size());
  for_each_object(numbers, [&](const ImageObject& object, std::size_t first, std::size_t end) {
    classify_for_coverage(object, std::span(numbers).subspan(first, end - first), context.range,
                          area_, classes.data() + first);
  });
  for (std::size_t k = 0; k < which.size(); ++k) take(classes_[which[k]], classes[k]);
}

void TileCoverage::add_edges(std::size_t begin) {
  const auto numbers = std::span<const std::uint32_t>(numbers_).subspan(begin);
  const auto classes = std::span<const CoverageTriangle>(classes_).subspan(begin);
  for_each_object(numbers, [&](const ImageObject& object, std::size_t first, std::size_t end) {
    outlines_.add(object, numbers.subspan(first, end - first), classes.subspan(first, end - first));
  });
}

// The number of front faces is also the same throughout a pixel that they do not open, and not 0 if
// its sample shows a front face. With many edges, hardly any pixel meets none of them.
bool TileCoverage::look_at_front() {
  constexpr std::size_t many = 256;
  if (outlines_.size() > many) return false;
  mark_open();
  for (std::size_t row = 0; row < size; ++row) full_[row] |= front_[row] & ~open_[row];
  open_.fill(~std::uint64_t{0});
  return !is_open(whole_tile(area_));
}

void TileCoverage::mark_open() {
  open_.fill(0);
  outlines_.find_pixels(open_);
  const TileBox whole = whole_tile(area_);
  for (const Shape& shape : open_shapes_) {
    TileRows met{};
    find_pixels_met(shape.sides(), whole, met);
    for (std::size_t row = 0; row < size; ++row) open_[row] |= met[row];
  }
}

bool TileCoverage::is_open(const TileBox& box) const {
  if (box.is_empty()) return false;
  const std::uint64_t columns = columns_between(box.left, box.right);
  for (auto row = static_cast<std::size_t>(box.top); row <= static_cast<std::size_t>(box.bottom);
       ++row) {
    if (open_[row] & ~full_[row] & columns) return true;
  }
  return false;
}

bool TileCoverage::misses_tile(const Shape& shape) const {
  const double width = area_.last_column - area_.first_column + 1.0;
  const double height = area_.last_row - area_.first_row + 1.0;
  return std::ranges::any_of(shape.sides(), [&](const UncertainHalfPlane& side) {
    return is_certainly_negative(side.a, side.b, side.c, side.error, {0, width, 0, height});
  });
}

void TileCoverage::look_at_open(std::size_t begin, const DrawContext& context) {
  for (std::size_t i = begin; i < numbers_.size(); ++i) {
    if (classes_[i].kind != CoverageClass::open) continue;
    const Shape shape = exact_shape(i, context);
    if (misses_tile(shape)) {
      classes_[i].kind = CoverageClass::nothing;
      continue;
    }
    add_pixels_inside(shape.sides(), whole_tile(area_), full_);
    open_shapes_.push_back(shape);
  }
}

bool TileCoverage::fill_large(std::size_t begin) {
  std::size_t filled = 0;
  for (std::size_t i = begin; i < numbers_.size(); ++i) {
    if (!classes_[i].is_large || !is_open(classes_[i].box)) continue;
    classes_[i].is_large = false;  // no need to do it again
    add_pixels_inside(shape_of(object_at(i), i).sides(), classes_[i].box, full_);
    if (++filled % 8 == 0 && !is_open(whole_tile(area_))) return true;
  }
  return !is_open(whole_tile(area_));
}

const ImageObject& TileCoverage::object_at(std::size_t i) {
  const std::uint32_t number = numbers_[i];
  if (!object_ || number < object_->first_number || number >= object_->end_number()) {
    object_ = &object_of(scene_.objects, number);
  }
  return *object_;
}

TileCoverage::Shape TileCoverage::shape_of(const ImageObject& object, std::size_t i) const {
  auto [A, B, C] = object.mesh.triangles[numbers_[i] - object.first_number];
  if (classes_[i].kind == CoverageClass::negative) std::swap(B, C);
  const auto edges =
      edges_over_tile({object.vertices[A], object.vertices[B], object.vertices[C]}, area_);
  Shape shape{
      .triangle = static_cast<std::uint32_t>(i), .is_open = false, .functions = {}, .count = 3};
  std::copy(edges.begin(), edges.end(), shape.functions.begin());
  return shape;
}

std::uint32_t TileCoverage::number_in_scene(std::size_t i) {
  return object_at(i).number_in_scene(numbers_[i]);
}

TileCoverage::Shape TileCoverage::exact_shape(std::size_t i, const DrawContext& context) {
  const TriangleSetup setup =
      exact_setup(context.referee.projected(number_in_scene(i)), context.perspective, area_);
  const auto [functions, count] = functions_over_tile(setup, context.range);
  return {static_cast<std::uint32_t>(i), true, functions, count};
}

}  // namespace fathom::fast
