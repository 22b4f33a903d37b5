#include "validation/scenes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

/// The point that `camera` (R = identity, t = 0, perspective) sees at (u, v) in depth z.
Vector3 seen_at(const Camera& camera, double u, double v, double z) {
  return {(u - camera.projection.cx) / camera.projection.fx * z,
          (v - camera.projection.cy) / camera.projection.fy * z, z};
}

/// The rings of the sphere from pole to pole, of 1, 4, 8, …, 4n, …, 8, 4, 1 vertices.
class Rings {
 public:
  explicit Rings(std::uint32_t n) : n_(n) {}

  [[nodiscard]] std::uint32_t count() const { return 2 * n_ + 1; }
  /// Vertices of a ring in each of its four quarters.
  [[nodiscard]] std::uint32_t quarter(std::uint32_t ring) const {
    return std::min(ring, 2 * n_ - ring);
  }
  [[nodiscard]] std::uint32_t size(std::uint32_t ring) const {
    return std::max(1U, 4 * quarter(ring));
  }
  /// Number of the vertex `step` steps around the ring.
  [[nodiscard]] std::uint32_t vertex(std::uint32_t ring, std::uint32_t step) const {
    return first(ring) + step % size(ring);
  }

 private:
  [[nodiscard]] std::uint32_t first(std::uint32_t ring) const {
    if (ring == 0) return 0;
    // 1 + 4 + 8 + … + 4(r − 1) from the pole to the equator, and as many from the other pole.
    if (ring <= n_) return 1 + 2 * ring * (ring - 1);
    const std::uint32_t left = 2 * n_ - ring;
    return 4 * n_ * n_ + 2 - (1 + 2 * left * (left + 1));
  }
  std::uint32_t n_;
};

/// The triangles between a ring and the next one below it. The larger of the two rings has one
/// vertex more in each quarter, so its steps face the vertices of the smaller one, and those of the
/// smaller one the vertices of the larger one that lie between.
void add_belt(const Rings& rings, std::uint32_t ring, Mesh& mesh) {
  const std::uint32_t above = rings.quarter(ring), below = rings.quarter(ring + 1);
  for (std::uint32_t q = 0; q < 4; ++q) {
    for (std::uint32_t step = 0; step < below; ++step) {
      mesh.triangles.push_back({rings.vertex(ring, q * above + step + (above > below ? 1 : 0)),
                                rings.vertex(ring + 1, q * below + step),
                                rings.vertex(ring + 1, q * below + step + 1)});
    }
    for (std::uint32_t step = 0; step < above; ++step) {
      mesh.triangles.push_back({rings.vertex(ring, q * above + step),
                                rings.vertex(ring + 1, q * below + step + (below > above ? 1 : 0)),
                                rings.vertex(ring, q * above + step + 1)});
    }
  }
}

/// One wall: cells × cells quads from `corner` along `across` and `up`, facing across × up.
Mesh wall(const Vector3& corner, const Vector3& across, const Vector3& up, std::uint32_t cells) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double s = static_cast<double>(i) / cells, t = static_cast<double>(j) / cells;
      add_vertex(mesh,
                 {corner[0] + s * across[0] + t * up[0], corner[1] + s * across[1] + t * up[1],
                  corner[2] + s * across[2] + t * up[2]});
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

}  // namespace

Camera simple_camera(const ImageSize& size, double focal) {
  Camera camera{.width = size.width, .height = size.height};
  camera.projection.fx = camera.projection.fy = focal * size.height;
  camera.projection.cx = size.width / 2.0;
  camera.projection.cy = size.height / 2.0;
  return camera;
}

Scene as_scene(std::vector<Mesh> meshes, const std::string& name) {
  Scene scene;
  scene.meshes = std::move(meshes);
  scene.sources.push_back({name, {}});
  std::uint64_t face = 0;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    Mesh& mesh = scene.meshes[i];
    mesh.face_count = mesh.triangles.size();
    scene.objects.push_back({.mesh = i, .name = name, .first_face = face});
    face += mesh.face_count;
  }
  return scene;
}

Mesh sphere(std::uint64_t triangles, const Vector3& centre, double radius) {
  const double n = std::round(std::sqrt(static_cast<double>(triangles) / 8));
  const Rings rings(static_cast<std::uint32_t>(std::clamp(n, 1.0, 20000.0)));
  Mesh mesh;
  for (std::uint32_t ring = 0; ring < rings.count(); ++ring) {
    const double polar = std::numbers::pi * ring / (rings.count() - 1);
    for (std::uint32_t step = 0; step < rings.size(ring); ++step) {
      const double around = 2 * std::numbers::pi * step / rings.size(ring);
      add_vertex(mesh, {centre[0] + radius * std::sin(polar) * std::sin(around),
                        centre[1] + radius * std::cos(polar),
                        centre[2] + radius * std::sin(polar) * std::cos(around)});
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings.count(); ++ring) add_belt(rings, ring, mesh);
  return mesh;
}

Mesh soup(std::uint32_t count, double depth_complexity, const Camera& camera) {
  Random random(50);
  Mesh mesh;
  const double width = camera.width, height = camera.height;
  // Corners uniform in a square of side s make a triangle of area 11/144·s² on average
  // [Hen83]; middles lie in a rectangle that reaches s/2 beyond the image, so that its border is
  // covered as its middle is: count·11/144·s² = depth_complexity·(width + s)·(height + s).
  const double k = depth_complexity * 144 / 11 / count;
  const double b = k * (width + height);
  const double side = (b + std::sqrt(b * b + 4 * (1 - k) * k * width * height)) / (2 * (1 - k));
  for (std::uint32_t i = 0; i < count; ++i) {
    const double u = random.between(-side / 2, width + side / 2);
    const double v = random.between(-side / 2, height + side / 2);
    const double z = random.between(2, 6);
    CornerIndices corners{};
    for (std::uint32_t& corner : corners) {
      corner = add_vertex(
          mesh, seen_at(camera, u + random.between(-side / 2, side / 2),
                        v + random.between(-side / 2, side / 2), z * random.between(0.95, 1.05)));
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

Mesh few_large(std::uint32_t count, const Camera& camera) {
  Random random(12);
  Mesh mesh;
  // An equilateral triangle whose inscribed circle holds the image one and a half times.
  const double radius = 1.5 * std::hypot(camera.width, camera.height);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = random.between(0, 2 * std::numbers::pi);
    CornerIndices corners{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double angle = turn + 2 * std::numbers::pi * k / 3;
      corners[k] = add_vertex(
          mesh, seen_at(camera, camera.projection.cx + radius * std::cos(angle),
                        camera.projection.cy + radius * std::sin(angle), random.between(1.5, 8)));
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

Mesh grid(std::uint32_t columns, std::uint32_t rows, double left, double top, double step) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      add_vertex(mesh, {left + step * i, top + step * j,
                        4 + 0.5 * std::sin(i / 40.0) * std::cos(j / 50.0)});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

std::vector<Mesh> room(std::uint32_t cells) {
  const double x = 4, y = 1.5, z = 3;
  return {wall({-x, -y, -z}, {2 * x, 0, 0}, {0, 2 * y, 0}, cells),
          wall({x, -y, z}, {-2 * x, 0, 0}, {0, 2 * y, 0}, cells),
          wall({x, -y, -z}, {0, 0, 2 * z}, {0, 2 * y, 0}, cells),
          wall({-x, -y, z}, {0, 0, -2 * z}, {0, 2 * y, 0}, cells),
          wall({-x, -y, z}, {2 * x, 0, 0}, {0, 0, -2 * z}, 1),
          wall({-x, y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}, 1),
          sphere(20'000, {-1.5, -0.7, -1}, 0.8),
          sphere(20'000, {1.8, -0.9, 0.5}, 0.6)};
}

}  // namespace fathom::bench
