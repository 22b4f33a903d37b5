#include "fathom/pipeline/output/temporal_history.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "fathom/geometry/eigen_arrays.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

using geometry::as_array;
using geometry::as_matrix;
using geometry::as_vector;

/// An affine map of points, or a projection of them to (U, V, W).
using Map34 = geometry::RowMatrix<double, 3, 4>;

/// (U, V, W) of points in the camera frame.
Map34 image_from_camera(const Projection& projection) {
  const auto [cx, cy] = principal_point(projection);
  const Eigen::Vector3d centre(cx, cy, 1);
  Map34 m = Map34::Zero();
  m.row(0).head<2>() << projection.fx, projection.skew;
  m(1, 1) = projection.fy;
  m.col(is_perspective(projection) ? 2 : 3) = centre;
  return m;
}

/// The map that applies `b`, which is affine, then `a`.
Map34 composed(const Map34& a, const Map34& b) {
  Map34 c = a.leftCols<3>() * b;
  c.col(3) += a.col(3);
  return c;
}

}  // namespace

ImageTriangles::ImageTriangles(const Scene& scene, const Camera& camera)
    : first_{0}, scene_(&scene) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Map34 image_from_world = composed(image_from_camera(camera.projection), camera_from_world);
  for (const Object& object : scene.objects) {
    as_matrix(image_from_mesh_.emplace_back()) =
        composed(image_from_world, geometry::rounded(object.world_from_mesh));
    first_.push_back(first_.back() +
                     static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size()));
  }
}

ImageTriangle ImageTriangles::operator[](std::uint32_t number) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), number);
  const auto object = static_cast<std::size_t>(after - first_.begin()) - 1;
  const Mesh& mesh = scene_->meshes[scene_->objects[object].mesh];
  const auto image_from_mesh = as_matrix(image_from_mesh_[object]);
  ImageTriangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint& p = mesh.vertices[mesh.triangles[number - first_[object]][k]];
    triangle[k] = as_array(image_from_mesh * Eigen::Vector4d(p.x, p.y, p.z, 1));
  }
  return triangle;
}

// (u, v, 1) is Σ βₖ·cornerₖ up to a factor; by Cramer's rule βₖ is (u, v, 1) · (the line through
// the other two corners), up to the same factor.
std::optional<std::array<double, 3>> weights_at(const ImageTriangle& triangle, double u, double v) {
  const Eigen::Vector3d a = as_vector(triangle[0]), b = as_vector(triangle[1]),
                        c = as_vector(triangle[2]), p(u, v, 1);
  const Eigen::Vector3d weights(b.cross(c).dot(p), c.cross(a).dot(p), a.cross(b).dot(p));
  const double sum = weights.sum();
  if (sum == 0) return std::nullopt;
  return as_array(weights / sum);
}

std::optional<std::array<double, 2>> place_of(const ImageTriangle& triangle,
                                              const std::array<double, 3>& weights) {
  const Eigen::Vector3d point = as_matrix(triangle).transpose() * as_vector(weights);
  if (!(point.z() > 0)) return std::nullopt;
  return std::array<double, 2>{point.x() / point.z(), point.y() / point.z()};
}

namespace {

bool is_inside(const ColourImage& image, double x, double y) {
  return x >= -0.5 && y >= -0.5 && x <= image.width - 0.5 && y <= image.height - 0.5;
}

/// Catmull and Rom's cubic [CR74]: weights of the four samples around a place, which is `t` beyond
/// the second sample. It keeps edges where linear interpolation, picture after picture, would blur
/// them.
std::array<double, 4> cubic_weights(double t) {
  return {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t),
          t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
}

/// The picture between pixels, with its border repeated; (0, 0) is the centre of the first pixel.
Colour smooth_between(const ColourImage& image, double x, double y) {
  const double i = std::floor(x), j = std::floor(y);
  const auto across = cubic_weights(x - i), down = cubic_weights(y - j);
  const auto limited = [](double place, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, static_cast<double>(size - 1)));
  };
  Colour sum{};
  for (std::size_t b = 0; b < 4; ++b) {
    for (std::size_t a = 0; a < 4; ++a) {
      const Colour& colour = image.at(limited(i - 1 + static_cast<double>(a), image.width),
                                      limited(j - 1 + static_cast<double>(b), image.height));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += across[a] * down[b] * colour[k];
    }
  }
  return sum;
}

/// Limits a colour to the range of the 3 × 3 pixels around.
Colour limited(Colour colour, const ColourImage& image, std::uint32_t x, std::uint32_t y) {
  Colour least = image.at(x, y), greatest = least;
  for (std::uint32_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, image.height - 1); ++j) {
    for (std::uint32_t i = x == 0 ? 0 : x - 1; i <= std::min(x + 1, image.width - 1); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], image.at(i, j)[k]);
        greatest[k] = std::max(greatest[k], image.at(i, j)[k]);
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) colour[k] = std::clamp(colour[k], least[k], greatest[k]);
  return colour;
}

}  // namespace

Colour TemporalHistory::earlier(const ColourImage& present, const PixelMoves& moves,
                                std::uint32_t x, std::uint32_t y) const {
  PixelMove move;
  if (settings_.reprojected) {
    const auto& known = moves[std::size_t{y} * present.width + x];
    if (!known || !is_inside(history_, x + known->x, y + known->y)) return present.at(x, y);
    move = *known;
  }
  const Colour colour = smooth_between(history_, x + move.x, y + move.y);
  return settings_.clamped ? limited(colour, present, x, y) : colour;
}

void TemporalHistory::add(const ColourImage& present, const PixelMoves& moves) {
  const double weight = std::max(1.0 / ++pictures_, settings_.weight);
  if (pictures_ == 1) {
    history_ = present;
    return;
  }
  ColourImage next = present;
  for (std::uint32_t y = 0; y < present.height; ++y) {
    check_interruption();
    for (std::uint32_t x = 0; x < present.width; ++x) {
      const Colour before = earlier(present, moves, x, y);
      Colour& colour = next.pixels[std::size_t{y} * present.width + x];
      for (std::size_t k = 0; k < 3; ++k) colour[k] = before[k] + weight * (colour[k] - before[k]);
    }
  }
  history_ = std::move(next);
}

}  // namespace fathom::pipeline
