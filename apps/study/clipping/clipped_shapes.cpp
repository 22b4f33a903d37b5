#include "apps/study/clipping/clipped_shapes.h"

#include <cmath>
#include <numbers>
#include <random>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/clipping/weiler_atherton.h"

namespace fathom::studies {
namespace {

using Exact = clipping::Rational;
using Ring = clipping::Ring<Exact>;
using Rings = clipping::Rings<Exact>;

/// The three ways to clip one polygon by one convex window.
struct Clipped {
  Rings reentrant;   ///< Sutherland–Hodgman: one ring at most
  Rings pieces;      ///< Weiler–Atherton: outlines (the subject has no holes)
  Rings decomposed;  ///< Sutherland–Hodgman, convex piece by convex piece
};

Clipped clip(const Ring& subject, const Ring& window) {
  const auto by_edges = [&](const Ring& ring) {
    return clipping::ring_of(clipping::sutherland_hodgman(clipping::corners_of(ring), window));
  };
  Clipped result;
  if (Ring ring = by_edges(subject); !ring.empty()) result.reentrant.push_back(ring);
  for (const Ring& convex : clipping::convex_pieces(subject))
    if (Ring ring = by_edges(convex); !ring.empty()) result.decomposed.push_back(ring);
  for (const auto& polygon :
       clipping::weiler_atherton<Exact>({subject}, {window}, clipping::SetOperation::intersection))
    result.pieces.push_back(polygon.outline);
  return result;
}

double length_of(const Rings& rings) {
  double length = 0;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &p = ring[i], &q = ring[(i + 1) % ring.size()];
      length += std::hypot(clipping::to_binary64(Exact(q.x - p.x)),
                           clipping::to_binary64(Exact(q.y - p.y)));
    }
  return length;
}

ClippingFigures figures_of(const Ring& subject, const Clipped& clipped) {
  const Exact area = clipping::signed_area(clipped.pieces);
  const double border = length_of(clipped.pieces);
  // With one piece the rings are the same, and the difference is rounding.
  const double bridges = clipped.pieces.size() > 1 ? length_of(clipped.reentrant) - border : 0;
  return {subject.size(),
          clipped.pieces.size(),
          clipped.decomposed.size(),
          border,
          bridges,
          clipped.decomposed.size() > clipped.pieces.size() ? length_of(clipped.decomposed) - border
                                                            : 0,
          clipping::signed_area(clipped.reentrant) == area &&
              clipping::signed_area(clipped.decomposed) == area};
}

Outline outline_of(const Ring& ring) {
  Outline outline;
  for (const auto& p : ring) {
    outline.emplace_back(clipping::to_binary64(p.x), clipping::to_binary64(p.y));
  }
  return outline;
}

std::vector<Outline> outlines_of(const Rings& rings) {
  std::vector<Outline> outlines;
  for (const Ring& ring : rings) outlines.push_back(outline_of(ring));
  return outlines;
}

struct Shape {
  std::string name;
  Ring ring, window;
};

Ring rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<Shape> named_shapes() {
  return {{"notch", {{0, 0}, {8, 0}, {8, 8}, {6, 2}, {2, 2}, {0, 8}}, rectangle(-1, 4, 9, 6)},
          {"comb",
           {{0, 0},
            {10, 0},
            {10, 6},
            {8, 6},
            {8, 1},
            {6, 1},
            {6, 6},
            {4, 6},
            {4, 1},
            {2, 1},
            {2, 6},
            {0, 6}},
           rectangle(-1, 3, 11, 5)},
          {"spiral",
           {{0, 0},
            {7, 0},
            {7, 7},
            {1, 7},
            {1, 2},
            {5, 2},
            {5, 5},
            {3, 5},
            {3, 4},
            {4, 4},
            {4, 3},
            {2, 3},
            {2, 6},
            {6, 6},
            {6, 1},
            {0, 1}},
           {{-1, 4}, {4, -1}, {8, 3}, {3, 8}}}};
}

/// A window off the centre, so that it meets the rays of the star.
Ring star_window() {
  return {{Exact(0.4), Exact(-0.9)},
          {Exact(0.9), Exact(-0.9)},
          {Exact(0.9), Exact(0.9)},
          {Exact(0.4), Exact(0.9)}};
}

}  // namespace

std::vector<ClippedShape> clipped_shapes() {
  std::vector<ClippedShape> all;
  for (const Shape& shape : named_shapes()) {
    const Clipped clipped = clip(shape.ring, shape.window);
    all.push_back({shape.name, figures_of(shape.ring, clipped), outline_of(shape.ring),
                   outline_of(shape.window), outlines_of(clipped.reentrant),
                   outlines_of(clipped.pieces), outlines_of(clipped.decomposed)});
  }
  return all;
}

Outline random_star(std::mt19937_64& random, std::size_t corners) {
  std::uniform_real_distribution<double> radius(0.2, 1);
  Outline ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double r = radius(random);
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return ring;
}

RandomPolygons clip_random_polygons(std::size_t corners, std::size_t polygons) {
  std::mt19937_64 random(corners);
  RandomPolygons average{corners, polygons};
  const auto n = static_cast<double>(polygons);
  for (std::size_t i = 0; i < polygons; ++i) {
    Ring ring;
    for (const auto& [x, y] : random_star(random, corners)) ring.push_back({Exact(x), Exact(y)});
    const ClippingFigures one = figures_of(ring, clip(ring, star_window()));
    average.in_pieces += one.pieces > 1 ? 1 : 0;
    average.pieces += static_cast<double>(one.pieces) / n;
    average.convex_pieces += static_cast<double>(one.convex_pieces) / n;
    if (one.border > 0) {
      average.bridge_percent += 100 * one.bridges / one.border / n;
      average.cut_percent += 100 * one.cuts / one.border / n;
    }
    average.areas_agree = average.areas_agree && one.areas_agree;
  }
  return average;
}

}  // namespace fathom::studies
