#include "tests/inputs/adversarial_scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/inputs/draw.h"

namespace fathom::checks {
namespace {

constexpr std::uint32_t image_width = 8, image_height = 6;

struct Builder {
  Draw draw;
  Camera camera = camera_of(image_width, image_height, 8);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;

  explicit Builder(std::uint64_t seed) : draw(seed) {}

  /// The point that the camera sees at (u, v) at a depth, if the camera is still a plain one.
  MeshPoint seen_at(double u, double v, double z) {
    if (is_orthographic(camera.projection)) {
      return {(u - camera.projection.cx) / camera.projection.fx,
              (v - camera.projection.cy) / camera.projection.fy, z};
    }
    return {(u - camera.projection.cx) / camera.projection.fx * z,
            (v - camera.projection.cy) / camera.projection.fy * z, z};
  }
  MeshPoint anywhere(double depth) {
    return seen_at(draw.unit() * 12 - 2, draw.unit() * 10 - 2, depth * (1 + draw.unit()));
  }
  void add(const MeshPoint& a, const MeshPoint& b, const MeshPoint& c) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
  void add_anywhere(double depth) { add(anywhere(depth), anywhere(depth), anywhere(depth)); }
  /// Triangles between the vertices that there are.
  void connect(int count) {
    for (int i = 0; i < count; ++i) {
      CornerIndices t{};
      for (auto& corner : t) {
        corner = static_cast<std::uint32_t>(draw.below(static_cast<int>(vertices.size())));
      }
      triangles.push_back(t);
    }
  }
  void turn_camera() {
    for (auto& row : camera.world_to_camera) {
      for (std::size_t k = 0; k < 3; ++k) row[k] = draw.within(1);
    }
  }
  void maybe_orthographic(int n) {
    if (draw.one_in(n)) camera.projection.model = ProjectionModel::orthographic;
  }
  void maybe_limit(double nearest, double farthest) {
    if (draw.one_in(3)) camera.near = nearest * (1 + draw.unit());
    if (draw.one_in(3)) camera.far = camera.near + farthest * draw.unit() + nearest;
  }
};

MeshPoint nudged(Draw& draw, const MeshPoint& p, int steps) {
  return {draw.nudged(p.x, steps), draw.nudged(p.y, steps), draw.nudged(p.z, steps)};
}

MeshPoint between(const MeshPoint& a, const MeshPoint& b, double t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}

void make_slivers(Builder& s) {
  s.maybe_orthographic(4);
  if (s.draw.one_in(3)) s.camera.projection.fx = 7.3, s.camera.projection.fy = -7.1;
  if (s.draw.one_in(2)) s.add_anywhere(5);
  for (int i = s.draw.between(1, 6); i > 0; --i) {
    const MeshPoint a = s.anywhere(2), b = s.anywhere(2);
    s.add(a, b, nudged(s.draw, between(a, b, s.draw.one_in(3) ? 0.5 : s.draw.unit() * 1.5), 3));
  }
}

void make_samples_on_edges(Builder& s) {
  s.maybe_orthographic(3);
  const double step = s.draw.one_in(2) ? 1 : 0.5;
  for (int i = s.draw.between(3, 8); i > 0; --i) {
    const double u = s.draw.between(-2, 9) * step + 0.5, v = s.draw.between(-2, 7) * step + 0.5;
    MeshPoint p = s.seen_at(u, v, s.draw.between(1, 4));
    if (s.draw.one_in(4)) p = nudged(s.draw, p, 2);
    s.vertices.push_back(p);
  }
  s.connect(s.draw.between(2, 8));
}

void make_ties(Builder& s) {
  s.maybe_orthographic(3);
  s.add_anywhere(2);
  for (int i = s.draw.between(1, 5); i > 0; --i) {
    const CornerIndices t =
        s.triangles[static_cast<std::size_t>(s.draw.below(static_cast<int>(s.triangles.size())))];
    switch (s.draw.below(4)) {
      case 0:  // the same triangle, turned
        s.triangles.push_back({t[1], t[2], t[0]});
        break;
      case 1:  // the same from behind
        s.triangles.push_back({t[1], t[0], t[2]});
        break;
      case 2:  // another triangle on an edge of it: equal depths along a line
        s.vertices.push_back(s.anywhere(2));
        s.triangles.push_back({t[0], t[1], static_cast<std::uint32_t>(s.vertices.size() - 1)});
        break;
      default:  // nearly the same
        s.add(nudged(s.draw, s.vertices[t[0]], 1), nudged(s.draw, s.vertices[t[1]], 1),
              nudged(s.draw, s.vertices[t[2]], 1));
    }
  }
}

/// Halfway between a binary32 number and the next, in [1, 2).
double midpoint(Draw& draw) {
  const auto x = static_cast<float>(1 + draw.unit());
  return (static_cast<double>(x) + static_cast<double>(std::nextafter(x, 4.0F))) / 2;
}

void make_midpoints(Builder& s) {
  s.maybe_orthographic(3);
  if (s.draw.one_in(3)) s.camera.world_to_camera[2][3] = s.draw.few_bits(0x1p-20);
  for (int i = s.draw.between(1, 4); i > 0; --i) {
    const double z = s.draw.nudged(midpoint(s.draw), 2), tilt = s.draw.one_in(2) ? 0 : 0x1p-30;
    MeshPoint p[3];
    for (MeshPoint& corner : p) {
      corner = s.seen_at(s.draw.between(-4, 20) + 0.5, s.draw.between(-4, 16) + 0.5, 1);
      corner.x *= z;
      corner.y *= z;
      corner.z = z + s.draw.between(-1, 1) * tilt;
    }
    s.add(p[0], p[1], p[2]);
  }
}

void make_coplanar_heaps(Builder& s) {
  s.maybe_orthographic(3);
  const double a = s.draw.few_bits(1), b = s.draw.few_bits(1);
  const int bits = s.draw.one_in(2) ? 4 : 40;
  const auto on_plane = [&] {
    const double x = std::round(std::ldexp(s.draw.within(2), bits)) * std::ldexp(1, -bits);
    const double y = std::round(std::ldexp(s.draw.within(2), bits)) * std::ldexp(1, -bits);
    return MeshPoint{x, y, 4 + a * x + b * y};
  };
  for (int i = s.draw.between(4, 8); i > 0; --i) s.vertices.push_back(on_plane());
  s.connect(s.draw.between(3, 10));
  if (s.draw.one_in(3)) s.turn_camera();
}

void make_around_the_eye(Builder& s) {
  s.camera.world_to_camera[2][3] = s.draw.one_in(2) ? 0 : s.draw.few_bits(1);
  if (s.draw.one_in(3)) s.turn_camera();
  for (int i = s.draw.between(3, 7); i > 0; --i) {
    MeshPoint p{s.draw.few_bits(2), s.draw.few_bits(2), s.draw.few_bits(2)};
    if (s.draw.one_in(3)) p = nudged(s.draw, p, 1);
    if (s.draw.one_in(6)) p = {s.draw.within(1), s.draw.within(1), s.draw.within(0x1p-40)};
    s.vertices.push_back(p);
  }
  s.connect(s.draw.between(1, 6));
  s.maybe_limit(0x1p-10, 2);
}

void make_intrinsics(Builder& s) {
  Camera& c = s.camera;
  s.maybe_orthographic(3);
  const int e = s.draw.between(-60, 60);
  c.projection.fx = s.draw.of_exponent(e);
  c.projection.fy = s.draw.of_exponent(s.draw.one_in(3) ? s.draw.between(-60, 60) : e);
  if (s.draw.one_in(2)) c.projection.skew = s.draw.of_exponent(e + s.draw.between(-4, 4));
  if (s.draw.one_in(3)) c.projection.cx = s.draw.of_exponent(s.draw.between(-30, 30));
  if (s.draw.one_in(3)) c.projection.cy = s.draw.of_exponent(s.draw.between(-30, 30));
  if (s.draw.one_in(3)) c.projection.pixel_centre = s.draw.few_bits(1);
  for (int i = s.draw.between(1, 4); i > 0; --i) {
    MeshPoint p[3];
    for (MeshPoint& corner : p) {
      const double v = s.draw.unit() * 10 - 2, u = s.draw.unit() * 12 - 2, z = 1 + s.draw.unit();
      const double depth = is_perspective(c.projection) ? z : 1;
      const double y = (v - c.projection.cy) / c.projection.fy;
      corner = {(u - c.projection.cx - c.projection.skew * y) / c.projection.fx * depth, y * depth,
                z};
    }
    s.add(p[0], p[1], p[2]);
  }
}

void make_cancellation(Builder& s) {
  s.maybe_orthographic(4);
  const double far = std::ldexp(1, s.draw.between(10, 45));
  const MeshPoint place{s.draw.few_bits(far), s.draw.few_bits(far), s.draw.few_bits(far)};
  if (s.draw.one_in(2)) s.turn_camera();
  std::array<double, 3> offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = s.camera.world_to_camera[i];
    offset[i] = row[0] * place.x + row[1] * place.y + row[2] * place.z;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    s.camera.world_to_camera[i][3] = (i == 2 ? 4 : 0) - offset[i];
  }
  for (int i = s.draw.between(3, 7); i > 0; --i) {
    s.vertices.push_back(
        {place.x + s.draw.within(3), place.y + s.draw.within(3), place.z + s.draw.within(3)});
  }
  s.connect(s.draw.between(1, 6));
}

void make_range_ends(Builder& s) {
  s.maybe_orthographic(3);
  const double near = 1 + s.draw.below(3) * 0.5, far = near + 1 + s.draw.below(2);
  s.camera.near = s.draw.one_in(6) ? 0 : s.draw.nudged(near, 1);
  s.camera.far = s.draw.one_in(6) ? std::numeric_limits<double>::infinity() : s.draw.nudged(far, 1);
  for (int i = s.draw.between(3, 8); i > 0; --i) {
    const double depths[] = {near, far, near + 0.25, far + 0.5, near - 0.25};
    const double z = s.draw.nudged(depths[s.draw.below(5)], 1);
    s.vertices.push_back(s.seen_at(s.draw.between(-3, 10) + 0.5, s.draw.between(-3, 8) + 0.5, z));
  }
  s.connect(s.draw.between(2, 7));
}

void make_exponents(Builder& s) {
  const auto any = [&] {
    return s.draw.one_in(5) ? 0 : s.draw.of_exponent(s.draw.between(-1060, 1020));
  };
  Camera& c = s.camera;
  s.maybe_orthographic(3);
  if (s.draw.one_in(2)) c.projection.fx = s.draw.of_exponent(s.draw.between(-1060, 1020));
  if (s.draw.one_in(2)) c.projection.fy = s.draw.of_exponent(s.draw.between(-1060, 1020));
  if (s.draw.one_in(3)) c.projection.skew = any();
  if (s.draw.one_in(3)) c.projection.cx = any();
  for (auto& row : c.world_to_camera) {
    for (double& entry : row) {
      if (s.draw.one_in(4)) entry = any();
    }
  }
  if (s.draw.one_in(3)) c.projection.cy = any();
  if (s.draw.one_in(4)) c.near = std::abs(any());
  if (s.draw.one_in(4)) c.far = std::abs(any());
  for (int i = s.draw.between(3, 6); i > 0; --i) s.vertices.push_back({any(), any(), any()});
  s.connect(s.draw.between(1, 5));
}

/// Coordinate k of every vertex is scaled by 2^a, column k of R by 2^(b − a), fx and fy by 2^(−b):
/// the image is an ordinary one, but the numbers and some of their products are not.
void make_conspiracies(Builder& s) {
  s.maybe_orthographic(3);
  for (int i = s.draw.between(1, 4); i > 0; --i) s.add_anywhere(2);
  if (s.draw.one_in(2)) {
    const double tiny = std::ldexp(1, s.draw.between(-1074, -1000));
    s.camera.world_to_camera[static_cast<std::size_t>(s.draw.below(3))]
                            [static_cast<std::size_t>(s.draw.below(4))] +=
        s.draw.one_in(2) ? tiny : 0;
  }
  int exponents[3];
  for (int& a : exponents) a = s.draw.between(-1000, 1000);
  // Of a depth, so that W stays where it was.
  if (s.draw.one_in(2)) exponents[2] = s.draw.between(-50, 50);
  for (MeshPoint& p : s.vertices) {
    p = {std::ldexp(p.x, exponents[0]), std::ldexp(p.y, exponents[1]),
         std::ldexp(p.z, exponents[2])};
  }
  int of_rows[3] = {s.draw.between(-60, 60), s.draw.between(-60, 60), 0};
  for (std::size_t i = 0; i < 3; ++i) {
    auto& row = s.camera.world_to_camera[i];
    for (std::size_t k = 0; k < 3; ++k) row[k] = std::ldexp(row[k], of_rows[i] - exponents[k]);
    row[3] = std::ldexp(row[3], of_rows[i]);
  }
  s.camera.projection.fx = std::ldexp(s.camera.projection.fx, -of_rows[0]);
  s.camera.projection.fy = std::ldexp(s.camera.projection.fy, -of_rows[1]);
}

/// Exponents of binary64 numbers, subnormal ones included.
constexpr int least_exponent = -1074, greatest_exponent = 1023;

/// Ordinary, any, or near the ends, where reciprocals overflow or are subnormal.
int any_exponent(Draw& draw) {
  switch (draw.below(4)) {
    case 0:
      return draw.between(least_exponent, greatest_exponent);
    case 1:
      return draw.between(least_exponent, least_exponent + 80);
    case 2:
      return draw.between(greatest_exponent - 80, greatest_exponent);
    default:
      return draw.between(-70, 70);
  }
}

/// The exponent of an entry of the pose, which takes numbers of about 2^(a − b) to about 2^a.
int exponent_of_entry(Draw& draw, int a) {
  const int b = draw.one_in(2) ? 0 : a - any_exponent(draw);
  const int least = std::max(least_exponent, a - greatest_exponent);
  const int greatest = std::min(greatest_exponent, a - least_exponent);
  return std::max(least, std::min(greatest, b));
}

/// near and far: near the depths of the scene, which are about 2^depth, or anywhere.
void limit_depths(Builder& s, int depth) {
  const auto limit = [&] {
    const int exponent = s.draw.one_in(3) ? any_exponent(s.draw) : depth + s.draw.between(-1, 1);
    return std::abs(s.draw.of_exponent(exponent));
  };
  if (s.draw.one_in(2)) s.camera.near = limit();
  if (s.draw.one_in(2)) s.camera.far = limit();
  if (s.camera.near > s.camera.far) std::swap(s.camera.near, s.camera.far);
}

/// A direction of the image: f and c of any exponents.
struct Axis {
  double mantissa;  // of f
  double centre;    // of the image that is seen
  int exponent;     // of the world's coordinates where w = 1

  /// `entry`: the exponent that the pose has for depths, whose exponent is `depth`.
  Axis(Builder& s, std::size_t row, int depth, int entry) {
    double& f = row == 0 ? s.camera.projection.fx : s.camera.projection.fy;
    double& c = row == 0 ? s.camera.projection.cx : s.camera.projection.cy;
    const int e = any_exponent(s.draw), own_entry = exponent_of_entry(s.draw, depth - e);
    f = s.draw.of_exponent(e);
    mantissa = std::ldexp(f, -e);
    centre = c;
    exponent = depth - e - own_entry;
    auto& pose = s.camera.world_to_camera[row];
    pose[row] = std::ldexp(1, own_entry);
    if (s.draw.one_in(2)) return;
    // The pose takes f·2^j·W from the image, to which c adds it.
    const bool perspective = is_perspective(s.camera.projection);
    const int j = any_exponent(s.draw) - e;
    c = std::ldexp(f, j);
    centre = 0;
    pose[perspective ? 2 : 3] = -std::ldexp(1, perspective ? j + entry : j);
  }
  /// The coordinate of a point that is seen at u, where W is w times a power of two.
  [[nodiscard]] double at(double u, double w) const {
    return std::ldexp((u - centre) / mantissa * w, exponent);
  }
};

void make_cameras(Builder& s) {
  s.maybe_orthographic(3);
  const bool perspective = is_perspective(s.camera.projection);
  const int depth = any_exponent(s.draw), entry = exponent_of_entry(s.draw, depth);
  s.camera.world_to_camera[2][2] = std::ldexp(1, entry);
  limit_depths(s, depth);
  const int in_image = perspective ? depth : 0;  // of W
  const Axis x(s, 0, in_image, entry), y(s, 1, in_image, entry);
  const bool around_the_eye = s.draw.one_in(3);
  for (int i = s.draw.between(3, 7); i > 0; --i) {
    double w = 1 + s.draw.unit();
    if (around_the_eye && s.draw.one_in(2)) w = s.draw.few_bits(2);
    if (s.draw.one_in(6)) w = s.draw.of_exponent(s.draw.between(-100, 0));
    const double u = s.draw.unit() * 16 - 4, v = s.draw.unit() * 12 - 3, W = perspective ? w : 1;
    s.vertices.push_back({x.at(u, W), y.at(v, W), std::ldexp(w, depth - entry)});
  }
  s.connect(s.draw.between(2, 6));
}

/// Places the mesh, and once more where that is drawn.
void place(Builder& s, Scene& scene) {
  const auto placed = [&] {
    Object object = scene.objects[0];
    object.placed_as_is = false;
    auto& rows = object.world_from_mesh.rows;
    const int kind = s.draw.below(5);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double entry = (i == k) + 0.25 * s.draw.between(-2, 2);
        rows[i][k] = kind == 0 ? Dyadic(entry) : Dyadic(entry + s.draw.within(0.1));
      }
      rows[i][3] = Dyadic(s.draw.few_bits(1));
    }
    if (kind == 1) rows[0] = {-rows[0][0], -rows[0][1], -rows[0][2], rows[0][3]};
    if (kind == 2) rows[1] = rows[2];  // flattened
    if (kind == 3) {
      const long e = s.draw.between(-600, 600);
      for (auto& row : rows) {
        for (Dyadic& entry : row) entry = entry.scaled(s.draw.one_in(3) ? e : 0);
      }
    }
    return object;
  };
  scene.objects.push_back(placed());
  if (s.draw.one_in(2)) scene.objects[0] = placed();
}

void make(Family family, Builder& s) {
  switch (family) {
    case Family::slivers:
      return make_slivers(s);
    case Family::samples_on_edges:
      return make_samples_on_edges(s);
    case Family::ties:
      return make_ties(s);
    case Family::midpoints:
      return make_midpoints(s);
    case Family::coplanar_heaps:
      return make_coplanar_heaps(s);
    case Family::around_the_eye:
      return make_around_the_eye(s);
    case Family::intrinsics:
      return make_intrinsics(s);
    case Family::cancellation:
      return make_cancellation(s);
    case Family::range_ends:
      return make_range_ends(s);
    case Family::placements:
      return make_samples_on_edges(s);
    case Family::exponents:
      return make_exponents(s);
    case Family::conspiracies:
      return make_conspiracies(s);
    case Family::cameras:
      return make_cameras(s);
  }
}

bool is_finite(const MeshPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace

std::string name_of(Family family) {
  constexpr std::array names{"slivers",        "samples_on_edges", "ties",       "midpoints",
                             "coplanar_heaps", "around_the_eye",   "intrinsics", "cancellation",
                             "range_ends",     "placements",       "exponents",  "conspiracies",
                             "cameras"};
  return names.at(static_cast<std::size_t>(family));
}

// A camera that is refused, or a coordinate that has overflowed, and the next seed is taken.
Case adversarial_case(Family family, std::uint64_t seed) {
  for (std::uint64_t attempt = seed << 8 | static_cast<std::uint64_t>(family);;
       attempt += 1ULL << 56) {
    Builder s(attempt);
    make(family, s);
    if (find_fault(s.camera)) continue;
    if (!std::all_of(s.vertices.begin(), s.vertices.end(), is_finite)) continue;
    Case c{scene_of(std::move(s.vertices), std::move(s.triangles)), s.camera};
    if (family == Family::placements) place(s, c.scene);
    return c;
  }
}

}  // namespace fathom::checks
