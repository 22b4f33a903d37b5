#include "tests/attribution/float_rasterizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/window_depth.h"

namespace fathom::test {
namespace {

using attribution::OtherMap;
using attribution::RasterModel;
using attribution::RendererModel;
using attribution::WindowDepth;
using attribution::WorldMesh;

struct Corner {
  float x, y, z, q;  // q: 1/w, of which a fragment shader makes its own depth (perspective)
  std::int64_t snapped_x, snapped_y;  // in 2⁻⁸ pixel
};

Corner corner_of(const std::array<double, 3>& p, const Camera& camera, const RasterModel& model) {
  std::array<float, 4> clip{};
  for (std::size_t r = 0; r < 4; ++r) {
    const float* row = model.matrix->data() + 4 * r;
    clip[r] = row[3];
    for (std::size_t k = 0; k < 3; ++k) clip[r] += row[k] * static_cast<float>(p[k]);
  }
  const float half_width = static_cast<float>(camera.width) / 2;
  const float half_height = static_cast<float>(camera.height) / 2;
  const float inverse = 1 / clip[3];
  const float x = half_width + half_width * (clip[0] * inverse);
  const float y = half_height - half_height * (clip[1] * inverse);
  const float ndc = clip[2] * inverse;
  const float z = model.mapping == Mapping::opengl ? 0.5F * ndc + 0.5F : ndc;
  return {x, y, z, inverse, std::llround(x * 256.0F), std::llround(y * 256.0F)};
}

/// What the fragment shader makes of q.
float written(float q, const attribution::WrittenDepth& shader) {
  const float t = shader.term + shader.factor * q;
  return shader.mapping == Mapping::log_ulrich ? shader.scale * std::log2(t) : t;
}

double in_storage(float z, const RasterModel& model, int bias_codes) {
  if (!is_unorm(model.storage)) return std::ldexp(double{z}, 0);
  const double codes = std::ldexp(1.0, bits_of(model.storage)) - 1;
  return std::clamp(std::nearbyint(double{z} * codes) + bias_codes, 0.0, codes) / codes;
}

/// Edge functions in whole numbers, the top-left rule by a bias of half a unit.
bool covers(const std::array<Corner, 3>& t, std::int64_t x, std::int64_t y) {
  std::int64_t area = 0;
  std::array<std::int64_t, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = t[i], &b = t[(i + 1) % 3];
    e[i] = (a.snapped_y - y) * (b.snapped_x - x) - (a.snapped_x - x) * (b.snapped_y - y);
    area += e[i];
  }
  if (area == 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = t[i], &b = t[(i + 1) % 3];
    const std::int64_t sign = area > 0 ? 1 : -1;
    const std::int64_t dx = sign * (b.snapped_x - a.snapped_x),
                       dy = sign * (b.snapped_y - a.snapped_y);
    const bool wins = dy > 0 || (dy == 0 && dx < 0);
    if (sign * e[i] < 0 || (e[i] == 0 && !wins)) return false;
  }
  return true;
}

/// Where an ideal lens shows what a distorting one shows at (x, y), in pixels: by bisection.
std::array<double, 2> without_lens(const Camera& c, const Fault& fault, double x, double y) {
  if (fault.k1 == 0 && fault.k2 == 0) return {x, y};
  const auto [cx, cy] = principal_point(c.projection);
  const double b = (y - cy) / c.projection.fy,
               a = (x - cx - c.projection.skew * b) / c.projection.fx;
  double low = 0, high = 2;  // times as far from the centre
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2, q = middle * middle * (a * a + b * b);
    (middle * (1 + q * (fault.k1 + q * fault.k2)) < 1 ? low : high) = middle;
  }
  return {cx + low * (x - cx), cy + low * (y - cy)};
}

}  // namespace

OtherMap draw_in_binary32(const WorldMesh& mesh, const Camera& camera,
                          const RendererModel& renderer, const Fault& fault) {
  const auto& model = std::get<RasterModel>(renderer.kind);
  const WindowDepth window = attribution::window_depth(
      camera.projection.model, model.stored_mapping(), camera.near, camera.far);
  const WindowDepth cut =
      attribution::window_depth(camera.projection.model, model.mapping, camera.near, camera.far);
  const std::size_t count = std::size_t{camera.width} * camera.height;
  const double cleared = window.reversed() ? 0 : 1;
  OtherMap map{camera.width,
               camera.height,
               {},
               std::vector<double>(count, cleared),
               std::vector<std::uint32_t>(count, no_surface)};
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
    if (fault.missing_triangle == n) continue;
    std::array<Corner, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
      t[i] = corner_of(mesh.points[mesh.triangles[n][i]], camera, model);
    }
    const bool of_q = model.written && model.written->of_w;
    std::array<float, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      values[i] = fault.affine ? static_cast<float>(cut.to_depth(t[i].z)) : of_q ? t[i].q : t[i].z;
    }
    const float bx = t[1].x - t[0].x, by = t[1].y - t[0].y, bz = values[1] - values[0];
    const float cx = t[2].x - t[0].x, cy = t[2].y - t[0].y, cz = values[2] - values[0];
    const float inverse = 1 / (by * cx - bx * cy);
    const float gx = (by * cz - cy * bz) * inverse, gy = (cx * bz - bx * cz) * inverse;
    const float z0 = values[0] - (gx * t[0].x + gy * t[0].y);
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto clamped = [](float v, std::uint32_t size) {
      return static_cast<std::uint32_t>(std::clamp(v, 0.0F, static_cast<float>(size - 1)));
    };
    for (std::uint32_t row = clamped(y0 - 2, camera.height); row <= clamped(y1 + 2, camera.height);
         ++row) {
      for (std::uint32_t column = clamped(x0 - 2, camera.width);
           column <= clamped(x1 + 2, camera.width); ++column) {
        const double x = column + 0.5 + fault.shift_x, y = row + 0.5 + fault.shift_y;
        if (!covers(t, std::llround(x * 256), std::llround(y * 256))) continue;
        float z = z0 + gx * static_cast<float>(x) + gy * static_cast<float>(y);
        if (fault.affine) {
          z = static_cast<float>(window.of_depth(z));
        } else if (model.written) {
          z = written(z, *model.written);
        }
        const double stored = in_storage(z, model, fault.bias_codes);
        const std::size_t i = std::size_t{row} * camera.width + column;
        const bool nearer = window.reversed() ? stored > map.windows[i] : stored < map.windows[i];
        if (!nearer && !(fault.last_of_equals && stored == map.windows[i])) continue;
        map.windows[i] = stored;
        map.triangles[i] = n;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    map.depths.push_back(map.triangles[i] == no_surface ? std::numeric_limits<double>::infinity()
                                                        : window.to_depth(map.windows[i]));
  }
  return map;
}

OtherMap trace_in_binary32(const WorldMesh& mesh, const Camera& camera, const Fault& fault) {
  const attribution::CameraRays rays = attribution::camera_rays(camera);
  OtherMap map{camera.width, camera.height, {}, {}, {}};
  using V = std::array<float, 3>;
  const auto minus = [](const V& a, const V& b) {
    return V{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto cross = [](const V& a, const V& b) {
    return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  std::vector<V> points;
  for (const auto& p : mesh.points) {
    points.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  for (std::uint32_t row = 0; row < camera.height; ++row) {
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const auto [x, y] =
          without_lens(camera, fault, column + 0.5 + fault.shift_x, row + 0.5 + fault.shift_y);
      V o{}, d{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&, x = x, y = y](const attribution::CameraRays::Affine& f) {
          return static_cast<float>(f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k]);
        };
        o[k] = at(rays.origin);
        d[k] = at(rays.direction);
      }
      float nearest = std::numeric_limits<float>::infinity();
      for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        if (fault.missing_triangle == n) continue;
        const auto& [i, j, k] = mesh.triangles[n];
        const V e1 = minus(points[j], points[i]), e2 = minus(points[k], points[i]);
        const V p = cross(d, e2), s = minus(o, points[i]);
        const float det = dot(e1, p);
        if (det == 0) continue;
        const float u = dot(s, p) / det;
        const V q = cross(s, e1);
        const float v = dot(d, q) / det, t = dot(e2, q) / det;
        if (u < 0 || v < 0 || u + v > 1 || t <= 0) continue;
        nearest = std::min(nearest, t);
      }
      map.depths.push_back(nearest);
    }
  }
  return map;
}

}  // namespace fathom::test
