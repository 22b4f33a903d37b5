#include "apps/validate/faults/changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "fathom/attribution/truth.h"
#include "fathom/camera/projection.h"
#include "fathom/image/depth_map.h"

namespace fathom::validation {
namespace {

using attribution::OtherMap;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_surface(double depth) {
  return std::abs(depth) < infinity;
}

double rounded(double x) {
  return static_cast<double>(static_cast<float>(x));
}

void set(OtherMap& map, std::size_t pixel, double value) {
  map.values[pixel] = map.depths[pixel] = value;
}

/// Of a pixel, in the image.
std::array<double, 2> centre_of(const OtherMap& map, std::size_t pixel) {
  const std::size_t column = pixel % map.width, row = pixel / map.width;
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

/// Pixels with a surface, in an order that is random but always the same.
std::vector<std::size_t> shuffled_surfaces(const OtherMap& map) {
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    if (is_surface(map.depths[i])) pixels.push_back(i);
  }
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same pixels in every run
  for (std::size_t i = pixels.size(); i > 1; --i) std::swap(pixels[i - 1], pixels[random() % i]);
  return pixels;
}

void change_first(OtherMap& map, std::size_t count, const std::function<double(double)>& f) {
  const std::vector<std::size_t> pixels = shuffled_surfaces(map);
  for (std::size_t k = 0; k < std::min(count, pixels.size()); ++k) {
    set(map, pixels[k], rounded(f(map.depths[pixels[k]])));
  }
}

/// The map whose pixel (x, y) is what `from(x, y)` gives: a pixel's index, or none.
template <class From>
void rearrange(OtherMap& map, const From& from) {
  const std::vector<double> depths = map.depths;
  for (std::size_t y = 0; y < map.height; ++y) {
    for (std::size_t x = 0; x < map.width; ++x) {
      const auto column = from(static_cast<long>(x), static_cast<long>(y)).first;
      const auto row = from(static_cast<long>(x), static_cast<long>(y)).second;
      const bool is_inside = column >= 0 && row >= 0 && column < static_cast<long>(map.width) &&
                             row < static_cast<long>(map.height);
      const double depth =
          is_inside
              ? depths[static_cast<std::size_t>(row) * map.width + static_cast<std::size_t>(column)]
              : infinity;
      set(map, y * map.width + x, depth);
    }
  }
}

/// A corner in the image, and its depth.
struct ImageCorner {
  double x = 0, y = 0, depth = 0;
};

ImageCorner in_image(const attribution::Truth& truth, std::uint32_t point) {
  const Camera& c = truth.camera;
  const auto& p = truth.mesh.points[point];
  std::array<double, 3> q{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = c.world_to_camera[i];
    q[i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  }
  const auto [x, y] = RoundedProjection(c.projection).image_of(q);
  return {x, y, q[2]};
}

double linear_depth(const attribution::Truth& truth, std::uint32_t triangle, double x, double y) {
  const auto& [i, j, k] = truth.mesh.triangles[triangle];
  const ImageCorner a = in_image(truth, i), b = in_image(truth, j), c = in_image(truth, k);
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
  const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
  return a.depth + u * (b.depth - a.depth) + v * (c.depth - a.depth);
}

}  // namespace

double to_window(double depth, double near, double far) {
  return far / (far - near) * (1 - near / depth);
}
double from_window(double window, double near, double far) {
  return far * near / (far - window * (far - near));
}

MapChange each_depth(std::function<double(double, double, const Camera&)> f) {
  return [f = std::move(f)](OtherMap& map, const RightMap& right, double size) {
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      if (!is_surface(map.depths[i])) continue;
      set(map, i, rounded(f(map.depths[i], size, right.truth.camera)));
    }
  };
}

MapChange background_of(std::function<double(const Camera&)> value) {
  return [value = std::move(value)](OtherMap& map, const RightMap& right, double) {
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      if (!is_surface(map.depths[i])) set(map, i, rounded(value(right.truth.camera)));
    }
  };
}

MapChange background_as(double value) {
  return background_of([value](const Camera&) { return value; });
}

MapChange both(MapChange first, MapChange second) {
  return [first = std::move(first), second = std::move(second)](
             OtherMap& map, const RightMap& right, double size) {
    first(map, right, size);
    second(map, right, size);
  };
}

MapChange moved_by(int columns, int rows) {
  return [columns, rows](OtherMap& map, const RightMap&, double) {
    rearrange(map, [&](long x, long y) { return std::pair(x + columns, y + rows); });
  };
}

MapChange mirrored(bool x_axis, bool y_axis) {
  return [x_axis, y_axis](OtherMap& map, const RightMap&, double) {
    rearrange(map, [&](long x, long y) {
      return std::pair(x_axis ? static_cast<long>(map.width) - 1 - x : x,
                       y_axis ? static_cast<long>(map.height) - 1 - y : y);
    });
  };
}

MapChange averaged(int size) {
  return [size](OtherMap& map, const RightMap& right, double) {
    const std::vector<double> depths = map.depths;
    const long width = static_cast<long>(map.width), height = static_cast<long>(map.height);
    for (long y = 0; y < height; ++y) {
      for (long x = 0; x < width; ++x) {
        double sum = 0;
        bool any = false;
        for (long dy = 0; dy < size; ++dy) {
          for (long dx = 0; dx < size; ++dx) {
            const long column = std::clamp(x + dx - size / 2, 0L, width - 1);
            const long row = std::clamp(y + dy - size / 2, 0L, height - 1);
            const double depth = depths[static_cast<std::size_t>(row * width + column)];
            any = any || is_surface(depth);
            sum += is_surface(depth) ? depth : right.truth.camera.far;
          }
        }
        const double mean = any ? rounded(sum / (size * size)) : infinity;
        set(map, static_cast<std::size_t>(y * width + x), mean);
      }
    }
  };
}

MapChange some_pixels(std::size_t count, std::function<double(double)> f) {
  return [count, f = std::move(f)](OtherMap& map, const RightMap&, double) {
    change_first(map, count, f);
  };
}

MapChange share_of_pixels(double share, std::function<double(double)> f) {
  return [share, f = std::move(f)](OtherMap& map, const RightMap&, double) {
    const auto surfaces = std::count_if(map.depths.begin(), map.depths.end(), is_surface);
    change_first(map, static_cast<std::size_t>(share * static_cast<double>(surfaces)), f);
  };
}

MapChange lines_as(bool rows, double first, double last, double value) {
  return [rows, first, last, value](OtherMap& map, const RightMap&, double) {
    const double count = rows ? map.height : map.width;
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      const auto line = static_cast<double>(rows ? i / map.width : i % map.width);
      if (line >= std::floor(first * count) && line < std::floor(last * count)) set(map, i, value);
    }
  };
}

MapChange line_as(bool rows, double at, double value) {
  return [rows, at, value](OtherMap& map, const RightMap& right, double size) {
    const double one = 1.0 / (rows ? map.height : map.width);
    lines_as(rows, at, at + 1.5 * one, value)(map, right, size);
  };
}

MapChange clipped_at(bool near, double share) {
  return [near, share](OtherMap& map, const RightMap&, double) {
    std::vector<double> depths;
    std::copy_if(map.depths.begin(), map.depths.end(), std::back_inserter(depths), is_surface);
    if (depths.empty()) return;
    std::sort(depths.begin(), depths.end());
    const double limit =
        depths[static_cast<std::size_t>(share * static_cast<double>(depths.size() - 1))];
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      if (near ? map.depths[i] < limit : map.depths[i] > limit) set(map, i, infinity);
    }
  };
}

MapChange affine_depths() {
  return [](OtherMap& map, const RightMap& right, double) {
    const attribution::Truth& truth = right.truth;
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      if (truth.triangles[i] == no_surface || !is_surface(map.depths[i])) continue;
      const auto [x, y] = centre_of(map, i);
      set(map, i, rounded(linear_depth(truth, truth.triangles[i], x, y)));
    }
  };
}

MapChange ray_distances() {
  return [](OtherMap& map, const RightMap& right, double) {
    const RoundedProjection projection(right.truth.camera.projection);
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
      if (!is_surface(map.depths[i])) continue;
      const auto [u, v] = centre_of(map, i);
      const auto [x, y] = projection.plane_point_at(u, v);
      set(map, i, rounded(map.depths[i] * std::sqrt(1 + x * x + y * y)));
    }
  };
}

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
