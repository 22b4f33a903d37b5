#include "apps/view/plane_prediction.h"

#include <bit>
#include <limits>

#include "apps/view/packing.h"

namespace fathom::view {
namespace {

/// In the frame of the camera.
struct Normal {
  double x, y, z;
  friend bool operator==(const Normal&, const Normal&) = default;
};

/// (u, v, 1) from the eye; (u, v) under an orthographic camera.
struct Ray {
  double u, v;
};

Normal normal_at(const PlaneHints& hints, std::size_t pixel) {
  const double x = hints.normals[0][pixel], y = hints.normals[1][pixel],
               z = hints.normals[2][pixel];
  const Pose& world = hints.world_from_camera;
  const auto part = [&](std::size_t i) {
    return world[0][i] * x + world[1][i] * y + world[2][i] * z;
  };
  return {part(0), part(1), part(2)};
}

Ray ray_through(const Projection& camera, double x, double y) {
  const double v = (y - camera.cy + camera.pixel_centre) / camera.fy;
  return {(x - camera.cx + camera.pixel_centre - camera.skew * v) / camera.fx, v};
}

class PlanePrediction {
 public:
  PlanePrediction(const std::vector<std::uint32_t>& words, const PlaneHints& hints,
                  std::uint32_t width, const TilePlace& tile)
      : words_(words), columns_(tile.columns), is_orthographic_(is_orthographic(hints.projection)) {
    rays_.reserve(words.size());
    normals_.reserve(words.size());
    for (std::size_t j = 0; j < tile.rows; ++j) {
      const std::size_t y = tile.y + j * tile.step;
      for (std::size_t i = 0; i < tile.columns; ++i) {
        const std::size_t x = tile.x + i * tile.step;
        rays_.push_back(
            ray_through(hints.projection, static_cast<double>(x), static_cast<double>(y)));
        normals_.push_back(normal_at(hints, y * width + x));
      }
    }
  }

  [[nodiscard]] ExpectedDepth expected(std::size_t k) const {
    const bool has_left = k % columns_ != 0, has_upper = k >= columns_;
    const bool has_right = (k + 1) % columns_ != 0;
    Mean heights;
    const auto add_same = [&](bool is_there, std::size_t distance) {
      if (!is_there || normals_[k - distance] != normals_[k]) return;
      heights.add(height(normals_[k], k - distance));
    };
    add_same(has_left, 1);
    add_same(has_upper, columns_);
    add_same(has_left && has_upper, columns_ + 1);
    add_same(has_right && has_upper, columns_ - 1);
    Mean depths;
    if (heights.count > 0) {
      depths.add(depth(normals_[k], heights.value(), k));
    } else {
      if (has_left) add_meeting(depths, k - 1, k);
      if (has_upper) add_meeting(depths, k - columns_, k);
    }
    const double found = depths.value();
    const std::uint32_t word = is_depth(found)
                                   ? std::bit_cast<std::uint32_t>(static_cast<float>(found))
                               : has_left  ? words_[k - 1]
                               : has_upper ? words_[k - columns_]
                                           : 0;
    return {word, heights.count > 0};
  }

 private:
  /// NaN if there is nothing.
  struct Mean {
    double sum = 0;
    int count = 0;
    void add(double value) {
      sum += value;
      ++count;
    }
    [[nodiscard]] double value() const { return sum / count; }
  };

  static bool is_depth(double z) { return z > 0 && z <= double{std::numeric_limits<float>::max()}; }

  [[nodiscard]] double slope(const Normal& n, const Ray& ray) const {
    return is_orthographic_ ? n.z : n.x * ray.u + n.y * ray.v + n.z;
  }
  [[nodiscard]] double offset(const Normal& n, const Ray& ray) const {
    return is_orthographic_ ? n.x * ray.u + n.y * ray.v : 0;
  }
  /// h of the plane with a normal through the point of a pixel.
  [[nodiscard]] double height(const Normal& n, std::size_t pixel) const {
    const double z = std::bit_cast<float>(words_[pixel]);
    return slope(n, rays_[pixel]) * z + offset(n, rays_[pixel]);
  }
  [[nodiscard]] double depth(const Normal& n, double height, std::size_t pixel) const {
    return (height - offset(n, rays_[pixel])) / slope(n, rays_[pixel]);
  }

  void add_meeting(Mean& depths, std::size_t from, std::size_t to) const {
    const auto continued = [&](const Normal& n) { return depth(n, height(n, from), to); };
    const double mean = (continued(normals_[to]) + continued(normals_[from])) / 2;
    if (is_depth(mean)) depths.add(mean);
  }

  const std::vector<std::uint32_t>& words_;
  std::size_t columns_;
  bool is_orthographic_;
  std::vector<Ray> rays_;
  std::vector<Normal> normals_;
};

}  // namespace

std::vector<ExpectedDepth> expected_depths(const std::vector<std::uint32_t>& words,
                                           const PlaneHints& hints, std::uint32_t width,
                                           const TilePlace& tile) {
  const PlanePrediction prediction(words, hints, width, tile);
  std::vector<ExpectedDepth> expected(words.size());
  for (std::size_t k = 0; k < words.size(); ++k) expected[k] = prediction.expected(k);
  return expected;
}

}  // namespace fathom::view
