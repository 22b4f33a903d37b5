#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/parts/edge_setup.h"

/// The judge of the kernels: slow, in whole numbers, pixel by pixel from the definition. It shares
/// no code with what it judges but the plane of a triangle's depth.
namespace fathom::bench {

/// A number for each pixel, row by row; several such pictures one after another.
using Picture = std::vector<double>;

/// Whether the centre of a pixel belongs to a triangle. Half-open: whether it does when it is moved
/// to the right by less than any number, and down by far less.
bool covers(const SnappedTriangle& triangle, std::int64_t column, std::int64_t row, EdgeRule rule);

/// The sum of the weights (EdgeSetup) of the triangles that cover each pixel.
Picture exact_layers(const SnappedScene& scene, EdgeRule rule = EdgeRule::half_open);

/// The nearest triangle at each pixel: its window depth, 1 where there is none; then its number
/// plus one, 0 where there is none. Of equally near ones the first.
Picture exact_nearest(const SnappedScene& scene);

/// How many pixels all triangles cover, each counted for itself.
std::uint64_t covered_pixels(const SnappedScene& scene, EdgeRule rule);

/// Pixels by the two rules of EdgeRule.
struct RuleCounts {
  std::string name;
  std::uint64_t half_open = 0, closed = 0;
};

/// The demo of the textbooks (study/course/demo.h): its near and its far triangle.
std::vector<RuleCounts> closed_edges_of_demo();

/// The pixels that the triangles of a scene cover, each triangle counted for itself. Closed edges
/// count a centre on an edge that two triangles share twice.
RuleCounts closed_edges(const std::string& name, const SnappedScene& scene);

}  // namespace fathom::bench
