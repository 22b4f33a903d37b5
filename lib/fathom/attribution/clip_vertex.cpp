#include "fathom/attribution/clip_vertex.h"

#include <algorithm>
#include <cmath>

#include "fathom/attribution/fragment_source.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff;

using Row = std::array<double, 4>;
using Matrix = std::array<Row, 4>;

/// Rows of x, y (up), z, w over the camera frame (x, y, depth, 1), as OpenGL has them.
Matrix clip_from_camera(const Camera& camera, const WindowDepth& window) {
  const double w = camera.width, h = camera.height;
  const double cx = camera.cx + (0.5 - camera.pixel_centre);
  const double cy = camera.cy + (0.5 - camera.pixel_centre);
  const double xx = 2 * camera.fx / w, xy = 2 * camera.skew / w, x1 = 2 * cx / w - 1;
  const double yy = -2 * camera.fy / h, y1 = 1 - 2 * cy / h;
  double a = window.a, b = window.b;
  if (window.minus_one_to_one) {  // 2z − w
    a = window.perspective ? 2 * a - 1 : 2 * a;
    b = window.perspective ? 2 * b : 2 * b - 1;
  }
  if (window.perspective) {
    return {{{xx, xy, x1, 0}, {0, yy, y1, 0}, {0, 0, a, b}, {0, 0, 1, 0}}};
  }
  return {{{xx, xy, 0, x1}, {0, yy, 0, y1}, {0, 0, a, b}, {0, 0, 0, 1}}};
}

Matrix camera_from_world(const Camera& camera) {
  const auto& m = camera.world_to_camera;
  return {m[0], m[1], m[2], {0, 0, 0, 1}};
}

/// One row of the product of both matrices, shifted: value = row·(p − shift, 1). `magnitude` bounds
/// what roundings are relative to, `loss` what was lost in making the row in binary64.
struct ClipRow {
  Row row{}, magnitude{};
  double loss = 0;
};

ClipRow make_row(const Row& projection, const Matrix& view, const RendererModel& model) {
  ClipRow made;
  std::array<double, 3> shift = model.shift;
  for (std::size_t j = 0; j < 4; ++j) {
    Row eye = view[j];
    for (std::size_t k = 0; k < 3; ++k) {
      made.loss += std::abs(projection[j] * eye[k] * shift[k]);
      eye[3] += eye[k] * shift[k];
    }
    made.loss += std::abs(projection[j] * view[j][3]);
    for (std::size_t k = 0; k < 4; ++k) {
      made.row[k] += projection[j] * eye[k];
      made.magnitude[k] += std::abs(projection[j] * eye[k]);
    }
  }
  if (model.premultiplied) {
    for (std::size_t k = 0; k < 4; ++k) made.magnitude[k] = std::abs(made.row[k]);
  }
  return made;
}

/// Roundings on the way from a position to a clip coordinate: product and sums of each matrix and
/// one to spare; where they are not known, an entry and the position itself.
double roundings(const RendererModel& model) {
  if (model.matrix) return 5;
  return model.premultiplied ? 7 : 13;
}

std::array<ClipRow, 4> clip_rows(const Camera& camera, const RendererModel& model) {
  const WindowDepth window =
      window_depth(camera.projection, model.mapping, camera.near, camera.far);
  const Matrix projection = clip_from_camera(camera, window), view = camera_from_world(camera);
  std::array<ClipRow, 4> rows;
  for (std::size_t r = 0; r < 4; ++r) rows[r] = make_row(projection[r], view, model);
  return rows;
}

/// The same for a matrix that is known: rows over (position − shift)·scale.
std::array<ClipRow, 4> known_rows(const std::array<float, 16>& matrix) {
  std::array<ClipRow, 4> rows;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      rows[r].row[k] = matrix[4 * r + k];
      rows[r].magnitude[k] = std::abs(rows[r].row[k]);
    }
  }
  return rows;
}

/// Signed distances from the borders, positive inside; linear in the clip coordinates.
double distance(const ClipVertex& v, unsigned border) {
  const auto& [x, y, z, w] = v.value;
  switch (border) {
    case 0:
      return z;
    case 1:
      return w - z;
    case 2:
      return w + x;
    case 3:
      return w - x;
    case 4:
      return w + y;
    default:
      return w - y;
  }
}

/// Near and far are cut as far out as the errors allow: the range of depths decides there, not the
/// cut.
double slack(const ClipVertex& v, unsigned border) {
  return border < 2 ? v.error[2] + (border == 1 ? v.error[3] : 0) : 0;
}

/// The corner that is cut off between `a` and `b`. The renderer's own lies on its own edge up to
/// the roundings of an interpolation; where along the edge does not matter, since what is beyond
/// the border is not drawn.
ClipVertex between(const ClipVertex& a, const ClipVertex& b, unsigned border) {
  const double from_a = distance(a, border) + slack(a, border);
  const double from_b = distance(b, border) + slack(b, border);
  const double t = from_a / (from_a - from_b);
  ClipVertex v{.borders = 1U << border | (a.borders & b.borders)};
  for (std::size_t k = 0; k < 4; ++k) {
    v.value[k] = a.value[k] + t * (b.value[k] - a.value[k]);
    v.error[k] = std::max(a.error[k], b.error[k]) +
                 4 * u * std::max(std::abs(a.value[k]), std::abs(b.value[k]));
  }
  return v;
}

std::vector<ClipVertex> cut_at(const std::vector<ClipVertex>& polygon, unsigned border) {
  std::vector<ClipVertex> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& a = polygon[i];
    const ClipVertex& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = distance(a, border) + slack(a, border) >= 0;
    const bool b_in = distance(b, border) + slack(b, border) >= 0;
    if (a_in) inside.push_back(a);
    if (a_in != b_in) inside.push_back(between(a, b, border));
  }
  return inside;
}

}  // namespace

std::array<float, 16> clip_from_held(const Camera& camera, const RendererModel& model) {
  const std::array<ClipRow, 4> rows = clip_rows(camera, model);
  std::array<float, 16> matrix{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      matrix[4 * r + k] =
          static_cast<float>(k < 3 ? rows[r].row[k] / model.scale[k] : rows[r].row[3]);
    }
  }
  return matrix;
}

std::vector<ClipVertex> clip_vertices(const WorldMesh& mesh, const Camera& camera,
                                      const RendererModel& model) {
  const bool known = model.matrix.has_value();
  const std::array<ClipRow, 4> rows = known ? known_rows(*model.matrix) : clip_rows(camera, model);
  const bool minus_one_to_one = model.mapping == Mapping::opengl;
  const double n = roundings(model) * u, gamma = n / (1 - n);
  std::vector<ClipVertex> vertices(mesh.points.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (std::size_t r = 0; r < 4; ++r) {
      double value = rows[r].row[3], magnitude = rows[r].magnitude[3];
      for (std::size_t k = 0; k < 3; ++k) {
        double held = mesh.points[i][k] - model.shift[k];
        if (known) held = static_cast<float>(held * model.scale[k]);
        value += rows[r].row[k] * held;
        magnitude += rows[r].magnitude[k] * std::abs(held);
      }
      vertices[i].value[r] = value;
      vertices[i].error[r] = own_roundings * gamma * magnitude + 0x1p-46 * rows[r].loss;
    }
    if (minus_one_to_one) {
      vertices[i].value[2] = (vertices[i].value[2] + vertices[i].value[3]) / 2;
      vertices[i].error[2] /= 2;
    }
  }
  return vertices;
}

bool is_certainly_outside(const std::array<const ClipVertex*, 3>& triangle) {
  for (unsigned border = 0; border < 6; ++border) {
    bool outside = true;
    for (const ClipVertex* v : triangle) {
      const double across = border < 2 ? v->error[2] : v->error[border < 4 ? 0 : 1];
      const double error = across + (border == 0 ? 0 : v->error[3]);
      outside = outside && distance(*v, border) + error < 0;
    }
    if (outside) return true;
  }
  return false;
}

std::vector<ClipVertex> cut(const std::array<const ClipVertex*, 3>& triangle, bool at_border) {
  std::vector<ClipVertex> polygon{*triangle[0], *triangle[1], *triangle[2]};
  const unsigned borders = at_border ? 6 : 1;
  for (unsigned border = 0; border < borders && !polygon.empty(); ++border) {
    polygon = cut_at(polygon, border);
  }
  return polygon;
}

WindowVertex to_window(const ClipVertex& v, const Camera& camera, const RendererModel& model) {
  const double w = v.value[3], rest = std::max(w - v.error[3], 0x1p-1000);
  // A quotient by w: errors of both, a reciprocal of two roundings and a product.
  const auto divided_error = [&](double quotient, double error) {
    return (error + std::abs(quotient) * v.error[3]) / rest + 4 * u * std::abs(quotient);
  };
  const double half_width = camera.width / 2.0, half_height = camera.height / 2.0;
  WindowVertex window{.borders = v.borders};
  window.x = half_width + half_width * (v.value[0] / w);
  window.y = half_height - half_height * (v.value[1] / w);
  window.z = v.value[2] / w;
  window.error_x = own_roundings * (half_width * divided_error(v.value[0] / w, v.error[0]) +
                                    2 * u * (std::abs(window.x) + half_width));
  window.error_y = own_roundings * (half_height * divided_error(v.value[1] / w, v.error[1]) +
                                    2 * u * (std::abs(window.y) + half_height));
  const double z = v.value[2] / w;
  // Of z_ndc/2 where there is one: z is that and a half.
  const double divided = model.mapping == Mapping::opengl ? z - 0.5 : z;
  window.error_z =
      own_roundings * (divided_error(divided, v.error[2]) + 2 * u * (std::abs(z) + 0.5));
  window.q = window.z;
  window.error_q = window.error_z;
  if (model.written && model.written->of_w) {  // a reciprocal of up to two roundings
    window.q = 1 / w;
    window.error_q = own_roundings * (v.error[3] / rest + 3 * u) / w;
  }
  if (!model.written) {
    window.z += model.bias;
    window.error_z += model.bias_error;
  }
  const double snap = std::ldexp(0.5, -model.subpixel_bits);
  window.snapped_x = window.error_x + snap;
  window.snapped_y = window.error_y + snap;
  return window;
}

}  // namespace fathom::attribution
