#include "fathom/fast/coverage/tile_coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "fathom/fast/coverage/area_bounds.h"
#include "fathom/fast/coverage/tile_functions.h"
#include "fathom/numeric/rounding.h"

namespace fathom::fast {
namespace {

/// With slabs between all ends and crossings, time grows with the cube of the number of edges.
constexpr std::size_t most_edges = 400;

}  // namespace

void TileCoverage::write(const Tile& tile, std::uint32_t tile_number, const Tile::Context& context,
                         float* values, std::uint32_t image_width) {
  area_ = tile.area();
  // The number of triangles that cover a point is the same throughout the inside of a pixel that is
  // not open, and at its sample it is 0 exactly where no surface is seen.
  look_at_samples(tile, shown_, front_);
  settled_.clear();
  settle(tile_number, context);
  const std::uint32_t columns = area_.last_column - area_.first_column + 1;
  auto next = settled_.begin();
  MapRow<float> row_values;
  for (std::uint32_t row = area_.first_row; row <= area_.last_row; ++row) {
    const std::uint32_t tile_row = row - area_.first_row;
    to_coverage(shown_[tile_row], row_values);
    for (; next != settled_.end() && next->pixel / size == tile_row; ++next) {
      row_values[next->pixel % size] = next->value;
    }
    scene_.rows.write(row_values, columns,
                      values + std::size_t{row} * image_width + area_.first_column);
  }
  scene_.rows.finish();
}

void TileCoverage::settle(std::uint32_t tile_number, const Tile::Context& context) {
  numbers_.clear();
  classes_.clear();
  open_shapes_.clear();
  left_.clear();
  full_.fill(0);
  open_.fill(~std::uint64_t{0});
  const std::size_t front = add_triangles(Side::front, tile_number, context);
  if (fill_large(front)) return;
  balance_edges(front);
  if (look_at_front()) return;
  const std::size_t back = add_triangles(Side::back, tile_number, context);
  balance_edges(back);
  find_open_pixels();
  if (fill_large(back)) return;
  for (std::size_t row = 0; row < size; ++row) open_[row] &= ~full_[row];
  meet_triangles();
  meet_edges();
  settle_open(context);
}

// The number of front faces is the same, too, throughout a pixel that they do not open, and not 0
// where one is seen. With many edges, hardly any pixel is left that none of them meets.
bool TileCoverage::look_at_front() {
  constexpr std::size_t many = 256;
  std::size_t edges = 0;
  for (const EdgesLeft& left : left_) edges += left.edges.size();
  if (edges > many) return false;
  find_open_pixels();
  for (std::size_t row = 0; row < size; ++row) full_[row] |= front_[row] & ~open_[row];
  open_.fill(~std::uint64_t{0});
  return !is_open(whole());
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

TileCoverage::Shape TileCoverage::exact_shape(std::size_t i, const Tile::Context& context) const {
  const TriangleSetup setup =
      exact_setup(context.referee.projected(numbers_[i]), context.perspective, area_);
  const auto [functions, count] = functions_over_tile(setup, context.range);
  return {static_cast<std::uint32_t>(i), true, functions, count};
}

void TileCoverage::meet(const TileBox& box, const Shape& shape) {
  constexpr int wide = 6;
  shapes_.push_back(shape);
  TileRows may_be_met;
  const bool is_wide = box.right - box.left >= wide;
  if (is_wide) find_pixels_met(shape.sides(), box, may_be_met);
  for (int top = box.top; top <= box.bottom; ++top) {
    const auto row = static_cast<std::size_t>(top);
    std::uint64_t bits =
        open_[row] & (is_wide ? may_be_met[row] : columns_between(box.left, box.right));
    for (; bits != 0; bits &= bits - 1) {
      const int column = std::countr_zero(bits);
      bool inside = true, outside = false;
      for (const UncertainHalfPlane& side : shape.sides()) {
        const auto [least, greatest] = values_in_pixel(side, column, top);
        inside = inside && least > side.error;
        outside = outside || greatest < -side.error;
      }
      if (inside) {
        open_[row] &= ~(std::uint64_t{1} << column);
        met_[row] |= std::uint64_t{1} << column;
      } else if (!outside) {
        shapes_at_.add(static_cast<std::uint32_t>(row) * size + static_cast<std::uint32_t>(column),
                       shapes_.size() - 1);
      }
    }
  }
}

void TileCoverage::meet_triangles() {
  auto next_open = open_shapes_.begin();
  met_.fill(0);
  shapes_.clear();
  shapes_at_.clear();
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const auto& [kind, is_large, box] = classes_[i];
    if (kind == CoverageClass::open) {
      meet(whole(), *next_open++);
      continue;
    }
    if (kind == CoverageClass::nothing || !is_open(box)) continue;
    meet(box, shape_of(object_at(i), i));
  }
  shapes_at_.sort();
}

void TileCoverage::Meetings::sort() {
  starts_.fill(0);
  for (const Meeting& meeting : unsorted_) ++starts_[meeting.pixel + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sorted_.resize(unsorted_.size());
  auto next = starts_;
  for (const Meeting& meeting : unsorted_) sorted_[next[meeting.pixel]++] = meeting.index;
}

void TileCoverage::settle_open(const Tile::Context& context) {
  for (std::size_t row = 0; row < size; ++row) {
    context.statistics.coverage_rounding.interval +=
        static_cast<std::uint64_t>(std::popcount(met_[row]));
    shown_[row] |= met_[row];
    for (std::uint64_t bits = open_[row]; bits != 0; bits &= bits - 1) {
      const auto pixel = static_cast<std::uint32_t>(row) * size +
                         static_cast<std::uint32_t>(std::countr_zero(bits));
      settled_.push_back({pixel, settle_pixel(pixel, context)});
    }
  }
}

// Rounded once, so within u·|x|.
SquarePoint TileCoverage::exact_corner(const ImageObject& object, std::uint32_t vertex,
                                       std::uint32_t pixel) const {
  const TriangleSource& triangles = scene_.frame.triangles;
  const Object& its_object = triangles.objects()[triangles.origin(object.first_number).object];
  const Camera& camera = scene_.frame.camera;
  const auto [U, V, W] =
      to_image(camera, to_camera(camera, to_world(its_object, object.mesh.vertices[vertex])));
  const std::uint32_t x = area_.first_column + pixel % size, y = area_.first_row + pixel / size;
  const Dyadic column = static_cast<double>(x), row = static_cast<double>(y);
  return {round_to_binary64(Ratio(U - column * W, W)), round_to_binary64(Ratio(V - row * W, W))};
}

Interval TileCoverage::area_between_edges(std::uint32_t pixel, Corners corners) {
  const double x = pixel % size, y = pixel / size;
  winding_.clear();
  for (const std::uint32_t i : edges_at_.at(pixel)) {
    const UnbalancedEdge& edge = unbalanced_[i];
    SquarePoint p{edge.from.x - x, edge.from.y - y}, q{edge.to.x - x, edge.to.y - y};
    double error = edge.error;
    if (corners == Corners::exact) {
      p = exact_corner(*edge.object, edge.from_vertex, pixel);
      q = exact_corner(*edge.object, edge.to_vertex, pixel);
      error = 0;
    }
    const double extent =
        std::max({std::abs(p.x), std::abs(p.y), std::abs(q.x), std::abs(q.y), 1.0});
    winding_.add(p, q, error + unit_roundoff<double> * extent, edge.times);
    if (winding_.size() > most_edges) return {0, 1};
  }
  return winding_.area([&](const SquarePoint& point) {
    int number = 0;
    for (const std::uint32_t i : shapes_at_.at(pixel)) {
      bool inside = true, outside = false;
      for (const auto& [a, b, c, error] : shapes_[i].sides()) {
        const double f = c + a * (x + point.x) + b * (y + point.y);
        inside = inside && f > error;
        outside = outside || f < -error;
      }
      if (!inside && !outside) return -1;
      if (inside) ++number;
    }
    return number;
  });
}

Interval TileCoverage::area_of_union(std::uint32_t pixel) {
  union_.clear();
  for (const std::uint32_t i : shapes_at_.at(pixel)) {
    add_to_union(shapes_[i], pixel % size, pixel / size);
  }
  return union_.area();
}

// Two polygons whose corresponding corners are at most ε apart in both coordinates differ only
// within √2·ε of the edges: on the way from one to the other, the boundary passes over every point
// where they differ. In the square such a strip has an area of at most 2√2·ε·(√2 + 2√2·ε) ≤ 4.1ε,
// three of them 12.3ε.
void TileCoverage::add_to_union(const Shape& shape, std::uint32_t x, std::uint32_t y) {
  if (shape.is_open) {
    ClippedSquare square;
    for (UncertainHalfPlane side : shape.sides()) {
      side.c += side.a * x + side.b * y;
      square.clip(side);
    }
    union_.add(square.corners(), square.area_error());
    return;
  }
  const std::uint32_t number = numbers_[shape.triangle];
  const ImageObject& object = object_of(scene_.objects, number);
  const auto& corners = object.mesh.triangles[number - object.first_number];
  std::array<SquarePoint, 3> p{};
  double extent = 1, e = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ImageVertex& vertex = object.vertices[corners[k]];
    p[k] = {vertex.u - (area_.first_column + x), vertex.v - (area_.first_row + y)};
    extent = std::max({extent, std::abs(p[k].x), std::abs(p[k].y)});
    e = std::max(e, vertex.position_error());
  }
  union_.add(p, area_bounds::moved_triangle * (e + unit_roundoff<double> * extent));
}

float TileCoverage::settle_pixel(std::uint32_t pixel, const Tile::Context& context) {
  TierCounts& counts = context.statistics.coverage_rounding;
  const auto shapes = shapes_at_.at(pixel);
  if (shapes.empty()) {
    ++counts.interval;
    return 0;
  }
  const auto settles = [&](const Interval& area) {
    return static_cast<float>(area.lower) == static_cast<float>(area.upper);
  };
  const bool any_open = std::any_of(shapes.begin(), shapes.end(),
                                    [&](std::uint32_t i) { return shapes_[i].is_open; });
  if (any_open && shapes.size() > most_edges) return settle_pixel_exactly(pixel, context);
  Interval area = any_open ? area_of_union(pixel) : area_between_edges(pixel, Corners::computed);
  if (!settles(area) && !any_open && winding_.size() <= most_edges) {
    ++context.statistics.areas_with_exact_ends;
    area = area_between_edges(pixel, Corners::exact);
  }
  const double more = (area.upper - area.lower) / 2 * (context.switches.widening - 1);
  if (!settles({area.lower - more, area.upper + more})) {
    context.note_doubt(area_.first_column + pixel % size, area_.first_row + pixel / size);
  }
  if (settles(area)) {
    ++counts.interval;
    return static_cast<float>(area.lower);
  }
  return settle_pixel_exactly(pixel, context);
}

float TileCoverage::settle_pixel_exactly(std::uint32_t pixel, const Tile::Context& context) {
  ++context.statistics.coverage_rounding.exact;
  exact_numbers_.clear();
  for (const std::uint32_t i : shapes_at_.at(pixel)) {
    exact_numbers_.push_back(numbers_[shapes_[i].triangle]);
  }
  return rounded_pixel_coverage(scene_.frame, exact_numbers_, area_.first_column + pixel % size,
                                area_.first_row + pixel / size);
}

}  // namespace fathom::fast
