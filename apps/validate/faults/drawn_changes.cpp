#include "apps/validate/faults/drawn_changes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "fathom/attribution/truth.h"
#include "fathom/image/depth_map.h"

namespace fathom::validation {
namespace {

using attribution::Truth;
using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Rodrigues' formula.
Matrix3 rotation(const std::array<double, 3>& turn) {
  const double angle = std::hypot(turn[0], turn[1], turn[2]);
  Matrix3 r{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (angle == 0) return r;
  const double x = turn[0] / angle, y = turn[1] / angle, z = turn[2] / angle;
  const double s = std::sin(angle), c = 1 - std::cos(angle);
  return {{{1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y},
           {c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x},
           {c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y)}}};
}

/// An invisible triangle that replaces removed triangles, so that other triangles keep their
/// numbers.
ValidationScene without(const ValidationScene& scene, const std::vector<bool>& gone) {
  ValidationScene result = scene;
  std::size_t triangle = 0;
  for (const Object& object : result.scene.objects) {
    for (CornerIndices& t : result.scene.meshes[object.mesh].triangles) {
      if (gone[triangle++]) t = {t[0], t[0], t[0]};
    }
  }
  return result;
}

/// Positive where the corners run anticlockwise in an image with y down: turned away.
double facing(const Truth& truth, std::size_t triangle) {
  std::array<std::array<double, 3>, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& world = truth.mesh.points[truth.mesh.triangles[triangle][k]];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = truth.camera.world_to_camera[i];
      p[k][i] = row[0] * world[0] + row[1] * world[1] + row[2] * world[2] + row[3];
    }
  }
  const auto minus = [](const auto& a, const auto& b) {
    return std::array{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto u = minus(p[1], p[0]), v = minus(p[2], p[0]);
  const std::array n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
  return is_perspective(truth.camera.projection) ? n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][2]
                                                 : n[2];
}

}  // namespace

SceneChange with_camera(CameraChange change) {
  return [change = std::move(change)](const ValidationScene& scene, double size) {
    ValidationScene result = scene;
    change(result.camera, size);
    return result;
  };
}

void turn_and_move(Camera& camera, const std::array<double, 3>& turn,
                   const std::array<double, 3>& move) {
  const Matrix3 r = rotation(turn);
  const auto before = camera.world_to_camera;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      camera.world_to_camera[i][k] =
          r[i][0] * before[0][k] + r[i][1] * before[1][k] + r[i][2] * before[2][k];
    }
    camera.world_to_camera[i][3] += move[i];
  }
}

SceneChange without_triangles(std::size_t count) {
  return [count](const ValidationScene& scene, double) {
    const Truth truth = attribution::make_truth(scene.scene, scene.camera);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> seen(truth.mesh.triangles.size());
    for (std::uint32_t t = 0; t < seen.size(); ++t) seen[t].second = t;
    for (const std::uint32_t t : truth.triangles) {
      if (t != no_surface) ++seen[t].first;
    }
    std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
      return std::pair(b.first, a.second) < std::pair(a.first, b.second);
    });
    std::vector<bool> gone(seen.size());
    for (std::size_t k = 0; k < std::min(count, seen.size()); ++k) gone[seen[k].second] = true;
    return without(scene, gone);
  };
}

SceneChange without_facing_triangles() {
  return [](const ValidationScene& scene, double) {
    const Truth truth = attribution::make_truth(scene.scene, scene.camera);
    std::vector<bool> gone(truth.mesh.triangles.size());
    for (std::size_t t = 0; t < gone.size(); ++t) gone[t] = facing(truth, t) < 0;
    return without(scene, gone);
  };
}

}  // namespace fathom::validation
