#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "apps/study/hidden_surface/sight.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/image/depth_map.h"

namespace fathom::studies {
namespace {

/// Pixels; what counts of them are their centres.
struct Area {
  std::uint32_t x_begin, y_begin, x_end, y_end;
};

class Subdivision {
 public:
  Subdivision(const Scene& scene, const Camera& camera)
      : camera_(camera), polygons_(eye_polygons(scene)) {
    for (const EyePolygon& p : polygons_) planes_.push_back(plane_of(p));
    sight_.ids.assign(std::size_t{camera.width} * camera.height, no_surface);
    sight_.polygons = polygons_.size();
  }

  Sight run() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < polygons_.size(); ++i) all.push_back(i);
    look_at({0, 0, camera_.width, camera_.height}, all);
    return std::move(sight_);
  }

 private:
  using Corners = std::array<EyePoint, 4>;

  [[nodiscard]] Corners corners_of(const Area& a) const {
    const double left = a.x_begin + 0.5, right = a.x_end - 0.5, top = a.y_begin + 0.5,
                 bottom = a.y_end - 0.5;
    return {ray_at(camera_, left, top), ray_at(camera_, right, top), ray_at(camera_, left, bottom),
            ray_at(camera_, right, bottom)};
  }

  /// One over the depth at which a ray meets a polygon's plane: linear in the image.
  [[nodiscard]] double inverse_depth(std::uint32_t i, const EyePoint& ray) const {
    using geometry::as_vector;
    return geometry::dot_from_left(as_vector(planes_[i].normal), as_vector(ray)) /
           planes_[i].offset;
  }

  /// Whether all corners lie outside one edge: then the polygon does not reach into the window.
  [[nodiscard]] bool is_apart(std::uint32_t i, const Corners& corners) const {
    const EyePolygon& p = polygons_[i];
    const double inside = volume(p[0], p[1], p[2]);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const bool outside = std::all_of(corners.begin(), corners.end(), [&](const EyePoint& ray) {
        const double side = volume(p[k], p[(k + 1) % p.size()], ray);
        return inside > 0 ? side < 0 : side > 0;
      });
      if (outside) return true;
    }
    return false;
  }

  [[nodiscard]] bool surrounds(std::uint32_t i, const Corners& corners) const {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const EyePoint& ray) { return is_met(polygons_[i], ray); });
  }

  /// The polygon that hides all others in the window.
  [[nodiscard]] std::optional<std::uint32_t> front(const std::vector<std::uint32_t>& candidates,
                                                   const Corners& corners) const {
    for (const std::uint32_t s : candidates) {
      if (!surrounds(s, corners)) continue;
      const bool nearest = std::all_of(candidates.begin(), candidates.end(), [&](std::uint32_t i) {
        return i == s || std::all_of(corners.begin(), corners.end(), [&](const EyePoint& ray) {
                 return inverse_depth(s, ray) > inverse_depth(i, ray);
               });
      });
      if (nearest) return s;
    }
    return std::nullopt;
  }

  void fill(const Area& a, std::uint32_t id) {
    for (std::uint32_t y = a.y_begin; y < a.y_end; ++y) {
      for (std::uint32_t x = a.x_begin; x < a.x_end; ++x) {
        sight_.ids[std::size_t{y} * camera_.width + x] = id;
      }
    }
  }

  void look_at_pixel(const Area& a, const std::vector<std::uint32_t>& candidates) {
    const EyePoint ray = ray_at(camera_, a.x_begin + 0.5, a.y_begin + 0.5);
    std::uint32_t nearest = no_surface;
    for (const std::uint32_t i : candidates) {
      if (!is_met(polygons_[i], ray)) continue;
      if (nearest == no_surface || inverse_depth(i, ray) > inverse_depth(nearest, ray)) nearest = i;
    }
    fill(a, nearest);
  }

  void look_at(const Area& a, const std::vector<std::uint32_t>& inherited) {
    if (a.x_begin == a.x_end || a.y_begin == a.y_end) return;
    ++sight_.steps;
    const Corners corners = corners_of(a);
    std::vector<std::uint32_t> candidates;
    for (const std::uint32_t i : inherited) {
      if (!is_apart(i, corners)) candidates.push_back(i);
    }
    if (candidates.empty()) return;
    if (a.x_end - a.x_begin == 1 && a.y_end - a.y_begin == 1) return look_at_pixel(a, candidates);
    if (const auto id = front(candidates, corners)) return fill(a, *id);
    const std::uint32_t x = (a.x_begin + a.x_end) / 2, y = (a.y_begin + a.y_end) / 2;
    look_at({a.x_begin, a.y_begin, x, y}, candidates);
    look_at({x, a.y_begin, a.x_end, y}, candidates);
    look_at({a.x_begin, y, x, a.y_end}, candidates);
    look_at({x, y, a.x_end, a.y_end}, candidates);
  }

  const Camera& camera_;
  std::vector<EyePolygon> polygons_;
  std::vector<EyePlane> planes_;
  Sight sight_;
};

}  // namespace

Sight warnock(const Scene& scene, const Camera& camera) {
  return Subdivision(scene, camera).run();
}

}  // namespace fathom::studies
