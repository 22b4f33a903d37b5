#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

/// Concave polygons clipped by a convex window in three ways, exactly; lengths are computed in
/// binary64.
namespace fathom::studies {

/// What the three answers for one polygon come to.
struct ClippingFigures {
  std::size_t corners = 0, pieces = 0, convex_pieces = 0;
  double border = 0;   ///< of the true pieces
  double bridges = 0;  ///< what Sutherland–Hodgman's ring is longer by
  double cuts = 0;     ///< what the decomposed pieces' rings are longer by
  bool areas_agree = false;
};

/// The corners of a ring, rounded to binary64.
using Outline = std::vector<std::pair<double, double>>;

/// A ring around the origin with a corner at each of `corners` even angles, as far out as drawn.
Outline random_star(std::mt19937_64& random, std::size_t corners);

/// A named polygon, its window, and the three answers as they are drawn.
struct ClippedShape {
  std::string name;
  ClippingFigures figures;
  Outline subject, window;
  std::vector<Outline> reentrant;   ///< Sutherland–Hodgman: one ring at most
  std::vector<Outline> pieces;      ///< Weiler–Atherton
  std::vector<Outline> decomposed;  ///< Sutherland–Hodgman, convex piece by convex piece
};
std::vector<ClippedShape> clipped_shapes();

/// What random polygons of one number of corners come to on average.
struct RandomPolygons {
  std::size_t corners = 0, polygons = 0, in_pieces = 0;
  double pieces = 0, convex_pieces = 0, bridge_percent = 0, cut_percent = 0;
  bool areas_agree = true;
};
RandomPolygons clip_random_polygons(std::size_t corners, std::size_t polygons);

}  // namespace fathom::studies
