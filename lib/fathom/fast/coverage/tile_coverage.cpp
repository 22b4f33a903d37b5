#include "fathom/fast/coverage/tile_coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "fathom/fast/coverage/square_edges.h"
#include "fathom/fast/lanes/each_bit.h"
#include "fathom/numeric/rounding.h"

namespace fathom::fast {
namespace {

/// With slabs between all ends and crossings, time grows with the cube of the number of edges.
constexpr std::size_t most_edges = 400;

bool settles(const Interval& area) {
  return static_cast<float>(area.lower) == static_cast<float>(area.upper);
}

}  // namespace

void TileCoverage::write(const Tile& tile, std::uint32_t tile_number, const DrawContext& context,
                         float* values, const MapLayout& layout) {
  area_ = tile.area();
  // The number of triangles that cover a point is the same throughout the inside of a pixel that is
  // not open, and at its sample it is 0 exactly where no surface is seen.
  look_at_samples(tile, shown_, front_);
  settled_.clear();
  if (find_open_pixels(tile_number, context)) {
    outlines_.list_edges(open_);
    prepare_counts();
    settle_open(context);
  }
  const std::uint32_t columns = area_.last_column - area_.first_column + 1;
  auto next = settled_.begin();
  MapRow<float> row_values;
  for (std::uint32_t row = area_.first_row; row <= area_.last_row; ++row) {
    const std::uint32_t tile_row = row - area_.first_row;
    to_coverage(shown_[tile_row], row_values);
    for (; next != settled_.end() && next->pixel / size == tile_row; ++next) {
      row_values[next->pixel % size] = next->value;
    }
    scene_.rows.write(row_values, columns, values + layout.pixel(area_.first_column, row));
  }
  scene_.rows.finish();
}

void TileCoverage::settle_open(const DrawContext& context) {
  for (std::size_t row = 0; row < size; ++row) {
    context.statistics.coverage_rounding.interval +=
        static_cast<std::uint64_t>(std::popcount(met_[row]));
    shown_[row] |= met_[row];
    for (const std::size_t column : EachBit(open_[row])) {
      const auto pixel = static_cast<std::uint32_t>(row * size + column);
      settled_.push_back({pixel, settle_pixel(pixel, context)});
    }
  }
}

namespace {

/// The parts of a segment, 0 to 1 from p to q, between which it is near the unit square; if that is
/// not the whole segment, the rest is at least about a pixel away from the square.
struct Part {
  double first = 0, last = 1;
};
Part part_near_square(const SquarePoint& p, const SquarePoint& q) {
  constexpr double margin = 2;
  Part part;
  const auto clip = [&](double start, double change) {
    const double a = (-margin - start) / change, b = (1 + margin - start) / change;
    if (!(std::abs(change) > 1)) return;
    part.first = std::max(part.first, std::min(a, b));
    part.last = std::min(part.last, std::max(a, b));
  };
  clip(p.x, q.x - p.x);
  clip(p.y, q.y - p.y);
  return part.first < part.last ? part : Part{};
}

/// A point of the image from exact homogeneous coordinates.
struct ExactPoint {
  Dyadic U, V, W;
};

/// The point that divides the line from p to q, relative to a pixel's corner; each coordinate is
/// rounded once.
SquarePoint point_between(const ExactPoint& p, const ExactPoint& q, const Dyadic& part,
                          const SquarePoint& corner) {
  const Dyadic rest = Dyadic(1) - part, W = p.W * q.W;
  const auto coordinate = [&](const Dyadic& a, const Dyadic& b, double origin) {
    return round_to_binary64(Ratio(rest * a * q.W + part * b * p.W - Dyadic(origin) * W, W));
  };
  return {coordinate(p.U, q.U, corner.x), coordinate(p.V, q.V, corner.y)};
}

}  // namespace

// Only the part near the pixel, so that coordinates are small.
std::pair<SquarePoint, SquarePoint> TileCoverage::exact_ends(const OutlineEdge& edge,
                                                             const SquarePoint& local,
                                                             const SquarePoint& corner) const {
  const TriangleSource& triangles = scene_.frame.triangles;
  const std::uint32_t number = edge.object->number_in_scene(edge.object->first_number);
  const Object& object = triangles.objects()[triangles.origin(number).object];
  const auto exact = [&](std::uint32_t vertex) {
    const Camera& camera = scene_.frame.camera;
    const auto [U, V, W] = to_image(
        camera.projection,
        to_camera(camera.world_to_camera, to_world(object, edge.object->mesh.vertices[vertex])));
    return ExactPoint{U, V, W};
  };
  const ExactPoint from = exact(edge.from_vertex), to = exact(edge.to_vertex);
  const auto [first, last] = part_near_square({edge.from.x - local.x, edge.from.y - local.y},
                                              {edge.to.x - local.x, edge.to.y - local.y});
  return {point_between(from, to, Dyadic(first), corner),
          point_between(from, to, Dyadic(last), corner)};
}

// Edges that certainly miss the pixel are left out, so that the area of a pixel next to an edge has
// no error.
Interval TileCoverage::area_between_edges(std::uint32_t pixel, Corners corners) {
  const std::uint32_t column = pixel % size, row = pixel / size;
  const double x = column, y = row;
  winding_.clear();
  for (const std::uint32_t i : outlines_.edges_at(pixel)) {
    const OutlineEdge& edge = outlines_.edge(i);
    SquarePoint p{edge.from.x - x, edge.from.y - y}, q{edge.to.x - x, edge.to.y - y};
    double error = edge.error;
    if (corners == Corners::exact) {
      std::tie(p, q) = exact_ends(edge, {x, y}, {area_.first_column + x, area_.first_row + y});
      error = 0;
    }
    error += unit_roundoff<double> *
             std::max({std::abs(p.x), std::abs(p.y), std::abs(q.x), std::abs(q.y), 1.0});
    const auto misses = [error](double a, double b) {
      return std::max(a, b) < -error || std::min(a, b) > 1 + error;
    };
    if (misses(p.x, q.x) || misses(p.y, q.y)) continue;
    winding_.add(p, q, error, edge.times);
    if (winding_.size() > most_edges) return {0, 1};
  }
  return winding_.area([&](const SquarePoint& point) {
    return number_at(pixel, {x + point.x, y + point.y});
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

float TileCoverage::settle_pixel(std::uint32_t pixel, const DrawContext& context) {
  const auto shapes = shapes_at_.at(pixel);
  const bool any_open = !open_shapes_.empty() && std::ranges::any_of(shapes, [&](std::uint32_t i) {
    return shapes_[i].is_open;
  });
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
  if (!settles(area)) return settle_pixel_exactly(pixel, context);
  ++context.statistics.coverage_rounding.interval;
  return static_cast<float>(area.lower);
}

float TileCoverage::settle_pixel_exactly(std::uint32_t pixel, const DrawContext& context) {
  ++context.statistics.coverage_rounding.exact;
  return rounded_pixel_coverage(scene_.frame, triangles_at(pixel),
                                area_.first_column + pixel % size, area_.first_row + pixel / size);
}

}  // namespace fathom::fast
