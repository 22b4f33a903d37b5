#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/attribution/truth.h"
#include "fathom/numeric/rounding.h"

/// Meshes that a renderer holds in parts: where their corners are, however it computed.
namespace fathom::attribution {
namespace {

using Point = std::array<double, 3>;
using Rows = std::array<std::array<double, 4>, 3>;
using Matrix = std::array<std::array<double, 4>, 4>;

std::shared_ptr<const std::vector<Point>> shared(std::vector<Point> points) {
  return std::make_shared<const std::vector<Point>>(std::move(points));
}

TEST(RasterParts, PointsOfTwoPartsAreNeverTheSame) {
  const RasterPart part{.points = shared({{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0, 0, 0}})};
  EXPECT_EQ(corner_numbers(std::vector<RasterPart>{part, part}),
            (std::vector<std::uint32_t>{0, 1, 0, 1, 4, 5, 4, 5}));
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t j = 0; j < 4; ++j) m[i][k] += a[i][j] * b[j][k];
    }
  }
  return m;
}

Matrix as_matrix(const Rows& rows) {
  return {rows[0], rows[1], rows[2], {0, 0, 0, 1}};
}

/// OpenGL's projection of the camera, near 1 and far 20.
Matrix projection(const Camera& c) {
  const double w = c.width, h = c.height, n = c.near, f = c.far;
  return {{{2 * c.projection.fx / w, 2 * c.projection.skew / w, 2 * c.projection.cx / w - 1, 0},
           {0, -2 * c.projection.fy / h, 1 - 2 * c.projection.cy / h, 0},
           {0, 0, (f + n) / (f - n), -2 * f * n / (f - n)},
           {0, 0, 1, 0}}};
}

/// As VTK does: matrices multiplied in binary64 and rounded once, with the shift in them; positions
/// less the shift rounded; the sum in binary32, from either end.
std::array<float, 4> renderer_clip(const Matrix& camera, const RasterPart& part, const Point& p,
                                   bool from_the_end) {
  Matrix shifted{
      {{1, 0, 0, part.shift[0]}, {0, 1, 0, part.shift[1]}, {0, 0, 1, part.shift[2]}, {0, 0, 0, 1}}};
  const Matrix m = product(camera, product(as_matrix(part.world_from_part), shifted));
  std::array<float, 4> clip{};
  for (std::size_t r = 0; r < 4; ++r) {
    std::array<float, 4> terms{};
    for (std::size_t k = 0; k < 4; ++k) {
      const float held = k == 3 ? 1.0F : static_cast<float>(p[k] - part.shift[k]);
      terms[k] = static_cast<float>(m[r][k]) * held;
    }
    clip[r] = from_the_end ? ((terms[3] + terms[2]) + terms[1]) + terms[0]
                           : ((terms[0] + terms[1]) + terms[2]) + terms[3];
  }
  return clip;
}

/// The exact clip coordinates, rounded once.
std::array<double, 4> exact_clip(const Camera& c, const RasterPart& part, const Point& p) {
  WorldFromMesh placement;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 4; ++k) placement.rows[r][k] = part.world_from_part[r][k];
  }
  const CameraPoint at = to_camera(c.world_to_camera, placement(MeshPoint{p[0], p[1], p[2]}));
  const std::array<double, 4> v{round_to_binary64(at.x), round_to_binary64(at.y),
                                round_to_binary64(at.z), 1};
  std::array<double, 4> clip{};
  const Matrix m = projection(c);
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) clip[r] += m[r][k] * v[k];
  }
  return clip;
}

/// Holds corners as a renderer makes them against their errors. Returns the greatest error that it
/// made, as a share of what is allowed.
double greatest_share(const std::vector<ClipVertex>& vertices, const Camera& camera,
                      const RasterPart& part, const std::vector<Point>& points) {
  const Matrix whole = product(projection(camera), as_matrix(camera.world_to_camera));
  double greatest = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto exact = exact_clip(camera, part, points[k]);
    const auto theirs = renderer_clip(whole, part, points[k], k % 2 == 0);
    for (std::size_t r = 0; r < 4; ++r) {
      const bool is_z = r == 2;  // given as w times the window depth
      const double e = is_z ? (exact[2] + exact[3]) / 2 : exact[r];
      const double t = is_z ? (double{theirs[2]} + theirs[3]) / 2 : theirs[r];
      const double error = vertices[k].error[r] + (is_z ? vertices[k].error[3] / 2 : 0);
      EXPECT_LE(std::abs(vertices[k].value[r] - e), vertices[k].error[r]) << r;
      EXPECT_LE(std::abs(t - e), error) << r;
      greatest = std::max(greatest, std::abs(t - e) / error);
    }
  }
  return greatest;
}

class Draws {
 public:
  double draw(double magnitude) {
    return std::uniform_real_distribution<double>(-magnitude, magnitude)(random_);
  }
  double power_below(int exponent) {
    return std::ldexp(1, static_cast<int>(random_() % static_cast<unsigned>(exponent)));
  }
  Camera camera() {
    Camera camera{.width = 160, .height = 90};
    camera.projection.fx = 150;
    camera.projection.fy = 130;
    camera.projection.cx = 70 + draw(20);
    camera.projection.cy = 45 + draw(20);
    camera.projection.skew = draw(10);
    camera.near = 1;
    camera.far = 20;
    for (auto& row : camera.world_to_camera) row = {draw(1), draw(1), draw(1), draw(3)};
    return camera;
  }

 private:
  std::mt19937_64 random_{7};
};

// Far placements that the shift or the view take back again: what cancels is lost in binary64, too.
TEST(RasterParts, CornersAreWithinTheirErrors) {
  Draws draws;
  double greatest = 0;
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    Camera camera = draws.camera();
    const double far = draws.power_below(44);
    RasterPart part;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = 0; k < 3; ++k) part.world_from_part[r][k] = draws.draw(1);
      part.world_from_part[r][3] = draws.draw(far);
      part.shift[r] = i % 3 == 0 ? 0 : draws.draw(far);
    }
    for (auto& v : camera.world_to_camera) {  // the view takes the placement back
      for (std::size_t k = 0; k < 3; ++k) v[3] -= v[k] * part.world_from_part[k][3];
    }
    std::vector<Point> points(4);
    for (Point& p : points) {
      for (std::size_t k = 0; k < 3; ++k) p[k] = part.shift[k] + draws.draw(2);
    }
    part.points = shared(points);
    RasterModel model;
    model.parts = {part};
    const auto vertices = clip_vertices(WorldMesh{points, {}}, camera, model);
    greatest = std::max(greatest, greatest_share(vertices, camera, part, points));
  }
  EXPECT_GT(greatest, 0.25);  // no bound that anything would meet
}

}  // namespace
}  // namespace fathom::attribution
