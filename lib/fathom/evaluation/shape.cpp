#include "fathom/evaluation/shape.h"

#include <string>

#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/nearest_surface.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/failures/errors.h"
#include "fathom/rays/camera_sight.h"
#include "fathom/rays/ray_tree.h"

namespace fathom::evaluation {
namespace {

/// Measured from points that lie on it in proportion to area.
class Surface : public Shape {
 public:
  Surface(const Scene& scene, const char* name, long power, const std::vector<Camera>& cameras,
          const SurfaceComparisonOptions& options)
      : source_(scene), triangles_(source_, power), tree_(triangles_) {
    try {
      points_ = surface_points(triangles_, options.points);
    } catch (const InputError& error) {
      throw InputError(std::string(name) + ": " + error.what());
    }
    if (cameras.empty()) return;
    rays_.emplace(scene, options.threads);
    for (const Camera& camera : cameras) sights_.emplace_back(*rays_, camera, options.cull);
  }

  [[nodiscard]] std::uint32_t points() const override {
    return static_cast<std::uint32_t>(points_.size());
  }

  [[nodiscard]] std::uint32_t number_at(std::uint32_t place) const override { return place; }

  [[nodiscard]] PlacedPoint point(std::uint32_t number) const override {
    return placed(points_[number], source_, triangles_);
  }

  [[nodiscard]] bool is_seen(std::uint32_t number, std::size_t& last_camera) const override {
    if (sights_.empty()) return true;
    const rays::SightEnd end(points_[number], source_, rays_->tree().power());
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const std::size_t camera = (last_camera + i) % sights_.size();
      if (!sights_[camera].sees(end)) continue;
      last_camera = camera;
      return true;
    }
    return false;
  }

  [[nodiscard]] Ratio squared_distance(const PlacedPoint& p) const override {
    return nearest_.squared_distance(p);
  }

  [[nodiscard]] std::uint64_t cloud_points() const override { return 0; }

 private:
  TriangleSource source_;
  PlacedTriangles triangles_;
  BoxTree tree_;
  NearestSurface nearest_{source_, triangles_, tree_};
  std::vector<SurfacePoint> points_;
  /// Only with cameras.
  std::optional<RayScene> rays_;
  std::vector<rays::CameraSight> sights_;
};

PlacedCloud thinned_cloud(const Scene& scene, long power, std::optional<double> density) {
  PlacedCloud cloud(scene, power);
  if (density) cloud.keep(thinned(cloud, *density));
  return cloud;
}

/// Measured from its points. All of them are seen: it has no surface that would hide one.
class Cloud : public Shape {
 public:
  Cloud(const Scene& scene, long power, std::optional<double> density)
      : all_(point_count(scene)), points_(thinned_cloud(scene, power, density)), tree_(points_) {}

  [[nodiscard]] std::uint32_t points() const override { return points_.count(); }
  [[nodiscard]] std::uint32_t number_at(std::uint32_t place) const override {
    return tree_.order()[place];
  }
  [[nodiscard]] PlacedPoint point(std::uint32_t number) const override {
    return {points_.world(number), points_[number]};
  }
  [[nodiscard]] bool is_seen(std::uint32_t, std::size_t&) const override { return true; }
  [[nodiscard]] Ratio squared_distance(const PlacedPoint& p) const override {
    return nearest_.squared_distance(p);
  }
  [[nodiscard]] std::uint64_t cloud_points() const override { return all_; }

 private:
  std::uint64_t all_;
  PlacedCloud points_;
  BoxTree tree_;
  NearestPoint nearest_{points_, tree_};
};

/// Memory of a triangle: its corners, its place in the tree's order, at most one node, its share of
/// the area.
constexpr double bytes_of_triangle = sizeof(PlacedTriangles::Corners) + sizeof(std::uint32_t) +
                                     sizeof(BoxTree::Node) + sizeof(double);
/// Additional memory of a triangle with cameras: its part of a tree of rays, and its corners and
/// box while that is built.
constexpr double bytes_of_seen_triangle = 106 + sizeof(PlacedTriangles::Corners) + 28;
/// Memory of a point of a cloud: itself, its place in the tree's order, at most half a node.
constexpr double bytes_of_cloud_point =
    sizeof(Vector) + sizeof(std::uint32_t) + sizeof(BoxTree::Node) / 2.0;
/// Memory of a point while a cloud is thinned: itself, its numbers, and at most two lists.
constexpr double bytes_of_thinned_point = sizeof(Vector) + 5 * sizeof(std::uint32_t);

}  // namespace

std::unique_ptr<const Shape> shape_of(const Scene& scene, const char* name, long power,
                                      const std::vector<Camera>& cameras,
                                      std::optional<double> density,
                                      const SurfaceComparisonOptions& options) {
  if (is_cloud(scene)) return std::make_unique<Cloud>(scene, power, density);
  return std::make_unique<Surface>(scene, name, power, cameras, options);
}

double bytes_of_shape(const Scene& scene, std::optional<double> density, bool with_sight,
                      const SurfaceComparisonOptions& options) {
  if (!is_cloud(scene)) {
    return static_cast<double>(triangle_count(scene)) *
               (bytes_of_triangle + (with_sight ? bytes_of_seen_triangle : 0)) +
           options.points * static_cast<double>(sizeof(SurfacePoint));
  }
  return static_cast<double>(point_count(scene)) *
         (bytes_of_cloud_point + (density ? bytes_of_thinned_point : 0));
}

}  // namespace fathom::evaluation
