#include "validation/studies/course/shared_edges.h"

#include <random>
#include <vector>

#include "fathom/pipeline/geometry/subpixel_grid.h"

namespace fathom::studies {
namespace {

using pipeline::GridPoint;
using pipeline::GridTriangle;

constexpr int pixels = 12;
constexpr int looks = 16;  // looks² samples a pixel

/// Corners of a grid of cells, moved at random within it and snapped; row by row.
std::vector<GridPoint> snapped_corners(int cells, int bits) {
  constexpr double cell = 0.75;  // of a pixel
  std::mt19937_64 random(2026);
  // (q − p) × (r − p) ≥ (1 − 2s)² − (2s)² = 1 − 4s cells > 0: none is turned over unsnapped.
  std::uniform_real_distribution<double> move(-0.2499 * cell, 0.2499 * cell);
  std::vector<GridPoint> corners;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool border = x == 0 || y == 0 || x == cells || y == cells;
      const double dx = move(random), dy = move(random);
      corners.push_back(
          pipeline::snap(cell * x + (border ? 0 : dx), cell * y + (border ? 0 : dy), bits));
    }
  }
  return corners;
}

/// Two triangles for each cell; those without area are counted and left out.
std::vector<GridTriangle> triangles_of(SharedEdges& counts) {
  constexpr int cells = 16;
  const std::vector<GridPoint> corners = snapped_corners(cells, counts.bits);
  std::vector<GridTriangle> triangles;
  const auto add = [&](int p, int q, int r) {
    const auto at = [&](int k) { return corners[static_cast<std::size_t>(k)]; };
    ++counts.triangles;
    const auto t = GridTriangle::of({at(p), at(q), at(r)});
    if (!t) {
      ++counts.without_area;
      return;
    }
    counts.turned_over += !t->counter_clockwise();
    triangles.push_back(*t);
  };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const int p = y * (cells + 1) + x, q = p + 1, r = p + cells + 1, s = r + 1;
      add(p, r, q);
      add(q, r, s);
    }
  }
  return triangles;
}

/// Counts a sample; its colour in the picture.
Rgb count(SharedEdges& counts, const std::vector<GridTriangle>& triangles,
          const GridPoint& sample) {
  int by_sign = 0, all = 0;
  bool turned = false;
  std::size_t which = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!triangles[i].covers(sample)) continue;
    ++all;
    by_sign += triangles[i].counter_clockwise() ? 1 : -1;
    turned = turned || !triangles[i].counter_clockwise();
    which = i;
  }
  ++counts.samples;
  counts.signed_not_one += by_sign != 1;
  counts.unsigned_not_one += all != 1;
  counts.unexplained += all != 1 && !turned;
  const auto shade = static_cast<std::uint8_t>(150 + which * 37 % 90);
  return all == 1 ? Rgb{static_cast<std::uint8_t>(shade - 40), shade, 255} : Rgb{220, 40, 30};
}

}  // namespace

SharedEdges count_shared_edges(int bits) {
  SharedEdges result{bits};
  const std::vector<GridTriangle> triangles = triangles_of(result);
  constexpr std::uint32_t side = pixels * looks;
  result.picture = RgbImage(side, side);
  constexpr std::int64_t step = pipeline::grid_one / looks;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      result.picture.at(x, y) =
          count(result, triangles, {x * step + step / 2, y * step + step / 2});
    }
  }
  return result;
}

}  // namespace fathom::studies
