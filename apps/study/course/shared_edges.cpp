#include "apps/study/course/shared_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <string>

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

/// The triangles of all cells, two for each.
std::vector<std::array<GridPoint, 3>> snapped_triangles(int bits) {
  constexpr int cells = 16;
  const std::vector<GridPoint> corners = snapped_corners(cells, bits);
  const auto at = [&](int k) { return corners[static_cast<std::size_t>(k)]; };
  std::vector<std::array<GridPoint, 3>> triangles;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const int p = y * (cells + 1) + x, q = p + 1, r = p + cells + 1, s = r + 1;
      triangles.push_back({at(p), at(r), at(q)});
      triangles.push_back({at(q), at(r), at(s)});
    }
  }
  return triangles;
}

/// How often a sample is covered.
struct Covered {
  int by_sign = 0, all = 0;
  bool turned = false;
};

constexpr std::int64_t samples_across = pixels * looks;

/// Adds a triangle to the samples that it covers.
void add(std::vector<Covered>& samples, const GridTriangle& triangle,
         const std::array<GridPoint, 3>& corners) {
  constexpr std::int64_t step = pipeline::grid_one / looks;
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const bool turned = !triangle.counter_clockwise();
  for (std::int64_t y = top / step; y <= std::min(bottom / step, samples_across - 1); ++y) {
    for (std::int64_t x = left / step; x <= std::min(right / step, samples_across - 1); ++x) {
      if (!triangle.covers({x * step + step / 2, y * step + step / 2})) continue;
      Covered& sample = samples[static_cast<std::size_t>(y * samples_across + x)];
      ++sample.all;
      sample.by_sign += turned ? -1 : 1;
      sample.turned = sample.turned || turned;
    }
  }
}

}  // namespace

SharedEdges count_shared_edges(int bits) {
  SharedEdges result{bits};
  std::vector<Covered> samples(static_cast<std::size_t>(samples_across * samples_across));
  for (const auto& corners : snapped_triangles(bits)) {
    ++result.triangles;
    const auto triangle = GridTriangle::of(corners);
    if (!triangle) {
      ++result.without_area;
      continue;
    }
    result.turned_over += !triangle->counter_clockwise();
    add(samples, *triangle, corners);
  }
  result.samples = samples.size();
  for (const Covered& sample : samples) {
    result.signed_not_one += sample.by_sign != 1;
    result.unsigned_not_one += sample.all != 1;
    result.unexplained += sample.all != 1 && !sample.turned;
    result.covers += static_cast<std::uint64_t>(sample.all);
    result.covered_by_turned.push_back(sample.turned);
  }
  return result;
}

SceneFiles shared_edges_files(int bits) {
  Scene scene = scene_of({}, {});
  Mesh& mesh = scene.meshes[0];
  const auto add_those = [&](bool turned_over) {
    for (const auto& corners : snapped_triangles(bits)) {
      const auto triangle = GridTriangle::of(corners);
      if (!triangle || triangle->counter_clockwise() == turned_over) continue;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      const float shade = 0.6F + static_cast<float>(mesh.triangles.size() * 37 % 90) / 255;
      const std::array<float, 4> blue{shade - 0.15F, shade, 1, 1}, red{0.86F, 0.16F, 0.12F, 1};
      for (const GridPoint& p : corners) {
        const auto place = [](std::int64_t x) {
          return static_cast<double>(x) * looks / static_cast<double>(pipeline::grid_one);
        };
        mesh.vertices.push_back({place(p.x), place(p.y), 0.5});
        mesh.colours.push_back(turned_over ? red : blue);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  };
  add_those(true);
  add_those(false);
  return scene_files("shared-edges-" + std::to_string(bits), scene,
                     window_camera(samples_across, samples_across));
}

RgbImage shared_edges_picture(int bits) {
  return pipeline_picture(shared_edges_files(bits).view, precise_options());
}

}  // namespace fathom::studies
