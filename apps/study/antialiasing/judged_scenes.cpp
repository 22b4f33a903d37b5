#include "apps/study/antialiasing/judged_scenes.h"

#include <array>
#include <string_view>

#include "apps/study/exact_picture.h"
#include "apps/study/pipeline_scenes.h"

namespace fathom::studies {
namespace {

/// Of the texture `checker`, which has eight squares each way, and starts black.
constexpr int squares_of_texture = 8;
bool is_white(int column, int row) {
  return (column + row) % 2 != 0;
}

/// Quadrangles, two triangles each.
class Tiles {
 public:
  void add(const std::array<MeshPoint, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), corners.begin(), corners.end());
    triangles_.push_back({first, first + 1, first + 2});
    triangles_.push_back({first, first + 2, first + 3});
  }
  [[nodiscard]] Scene scene() const { return scene_of(vertices_, triangles_); }

 private:
  std::vector<MeshPoint> vertices_;
  std::vector<CornerIndices> triangles_;
};

Judged judged_by_itself(Scene scene, const Camera& camera) {
  pipeline::ColourImage truth = exact_picture(scene, camera);
  return {std::move(scene), camera, false, std::move(truth)};
}

/// A sheet from corner to corner, in 8 × 8 parts of 2 triangles.
void add_sheet(Tiles& tiles, const std::array<MeshPoint, 3>& corners) {
  constexpr int parts = 8;
  const MeshPoint &o = corners[0], &p = corners[1], &q = corners[2];
  const auto at = [&](int i, int j) {
    const double s = static_cast<double>(i) / parts, t = static_cast<double>(j) / parts;
    return MeshPoint{o.x + s * (p.x - o.x) + t * (q.x - o.x),
                     o.y + s * (p.y - o.y) + t * (q.y - o.y),
                     o.z + s * (p.z - o.z) + t * (q.z - o.z)};
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j)
      tiles.add({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
}

constexpr std::string_view letters[] = {
    "####...##...#####..#..#...##...#...#", "#.....#..#....#....#..#..#..#..##.##",
    "###...####....#....####..#..#..#.#.#", "#.....#..#....#....#..#..#..#..#...#",
    "#.....#..#....#....#..#...##...#...#"};

}  // namespace

Judged star() {
  return judged_by_itself(siemens_star(36, 60, 64.3, 63.8), window_camera(128, 128));
}

Judged crossing_sheets() {
  Tiles tiles;
  add_sheet(tiles, {{{-1.1, -1, 3}, {0.9, -0.9, 5.1}, {-0.9, 1.2, 3.4}}});
  add_sheet(tiles, {{{-1, -1.1, 5}, {1.1, -0.8, 3}, {-1.2, 0.9, 4.7}}});
  Scene scene = tiles.scene();
  paint_each_triangle(scene);
  return judged_by_itself(std::move(scene), front_camera(128, 128, 0.5, 100));
}

Judged checkered_plane() {
  constexpr double size = 60, tile = 3, height = 1, square = tile / squares_of_texture;
  constexpr int columns = static_cast<int>(size / square);
  const Camera camera = front_camera(240, 160, 0.5, 100);
  Tiles tiles;
  for (int i = -columns; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (!is_white(i, j)) continue;
      const double x = i * square, z = j == 0 ? 0.1 : j * square, end = (j + 1) * square;
      tiles.add(
          {{{x, height, z}, {x + square, height, z}, {x + square, height, end}, {x, height, end}}});
    }
  }
  return {ground(size, tile, height), camera, true, exact_picture(tiles.scene(), camera)};
}

Judged checkered_wall() {
  // (u, v) = (0.35, 0.55) + (0.225 x − 0.05 y, 0.05 x + 0.225 y): corners from (0, 0) on.
  Scene scene = scene_of({{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}}, {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {0.9, 0.2}, {0.7, 1.1}, {-0.2, 0.9}};
  const auto place = [](int column, int row) {
    const double u = static_cast<double>(column) / squares_of_texture - 0.35;
    const double v = static_cast<double>(row) / squares_of_texture - 0.55;
    constexpr double determinant = 0.225 * 0.225 + 0.05 * 0.05;
    return MeshPoint{(0.225 * u + 0.05 * v) / determinant, (0.225 * v - 0.05 * u) / determinant, 2};
  };
  Tiles tiles;
  for (int i = -4; i < 12; ++i) {
    for (int j = -2; j < 12; ++j) {
      if (is_white(i, j))
        tiles.add({place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
    }
  }
  const Camera camera = front_camera(96, 96, 1, 10);
  return {std::move(scene), camera, true, exact_picture(tiles.scene(), camera)};
}

Judged text() {
  Tiles tiles;
  double y = 3;
  for (const std::string_view row : letters) {
    double x = 4;
    for (const char dot : row) {
      if (dot == '#')
        tiles.add({{{x, y, 0.5}, {x + 1, y, 0.5}, {x + 1, y + 1, 0.5}, {x, y + 1, 0.5}}});
      ++x;
    }
    ++y;
  }
  return judged_by_itself(tiles.scene(), window_camera(44, 11));
}

}  // namespace fathom::studies
