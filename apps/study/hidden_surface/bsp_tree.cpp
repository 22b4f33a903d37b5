#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "apps/study/hidden_surface/sight.h"
#include "fathom/image/depth_map.h"

namespace fathom::studies {
namespace {

/// Whether a ray from the origin meets a polygon, its outline included, without rounding.
template <class Point>
bool is_met_exactly(const std::vector<Point>& polygon, const Point& ray) {
  const Point eye(0, 0, 0);
  bool left = true, right = true;
  for (std::size_t i = 0; i < polygon.size() && (left || right); ++i) {
    const auto side = CGAL::orientation(eye, polygon[i], polygon[(i + 1) % polygon.size()], ray);
    left &= side != CGAL::NEGATIVE;
    right &= side != CGAL::POSITIVE;
  }
  return left || right;
}

struct InBinary64 {
  using Point = EyePoint;
  using Plane = EyePlane;

  static EyePoint point(const EyePoint& p) { return p; }
  static EyePoint rounded(const EyePoint& p) { return p; }
  static EyePlane plane(const EyePolygon& polygon) { return plane_of(polygon); }
  /// Positive, 0 or negative.
  static double side(const EyePlane& plane, const EyePoint& p) { return plane.at(p); }
  /// Where a segment with ends on different sides passes through the plane.
  static EyePoint cut(const EyePlane& plane, const EyePoint& a, const EyePoint& b) {
    const double va = plane.at(a), t = va / (va - plane.at(b));
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
  }
  static bool is_met_at(const EyePolygon& polygon, const Camera& camera, double x, double y) {
    return is_met(polygon, ray_at(camera, x, y));
  }
};

struct WithExactOutlines : InBinary64 {
  static bool is_met_at(const EyePolygon& polygon, const Camera& camera, double x, double y) {
    using CgalPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    const auto to_cgal = [](const EyePoint& p) { return CgalPoint(p[0], p[1], p[2]); };
    std::vector<CgalPoint> corners(polygon.size());
    std::transform(polygon.begin(), polygon.end(), corners.begin(), to_cgal);
    return is_met_exactly(corners, to_cgal(ray_at(camera, x, y)));
  }
};

struct Exact {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Point = Kernel::Point_3;
  using Plane = Kernel::Plane_3;

  static Point point(const EyePoint& p) { return {p[0], p[1], p[2]}; }
  static EyePoint rounded(const Point& p) {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }
  static Plane plane(const std::vector<Point>& polygon) {
    return {polygon[0], polygon[1], polygon[2]};
  }
  static int side(const Plane& plane, const Point& p) { return plane.oriented_side(p); }
  static Point cut(const Plane& plane, const Point& a, const Point& b) {
    const auto height = [&](const Point& p) {
      return plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d();
    };
    const Kernel::FT va = height(a);
    return a + va / (va - height(b)) * (b - a);
  }
  static bool is_met_at(const std::vector<Point>& polygon, const Camera& camera, double x,
                        double y) {
    const Kernel::FT u = (Kernel::FT(x) - camera.projection.cx) / camera.projection.fx,
                     v = (Kernel::FT(y) - camera.projection.cy) / camera.projection.fy;
    return is_met_exactly(polygon, Point(u, v, 1));
  }
};

template <class Arithmetic>
class Tree {
 public:
  explicit Tree(const Scene& scene) {
    std::vector<Piece> pieces;
    for (const EyePolygon& polygon : eye_polygons(scene)) {
      std::vector<Point> corners;
      for (const EyePoint& p : polygon) corners.push_back(Arithmetic::point(p));
      const Plane plane = Arithmetic::plane(corners);
      pieces.push_back({static_cast<std::uint32_t>(pieces.size()), std::move(corners), plane});
    }
    root_ = tree_of(std::move(pieces));
  }

  Sight seen_by(const Camera& camera) const {
    Sight sight;
    sight.ids.assign(std::size_t{camera.width} * camera.height, no_surface);
    sight.steps = sight.polygons = nodes_;
    paint(root_.get(), camera, sight);
    return sight;
  }

 private:
  using Point = typename Arithmetic::Point;
  using Plane = typename Arithmetic::Plane;

  /// Of a triangle, whose plane it keeps: a sliver's own corners tell no plane.
  struct Piece {
    std::uint32_t id;
    std::vector<Point> corners;
    Plane plane;
  };

  struct Node {
    Piece on;
    std::unique_ptr<Node> positive, negative;
  };

  /// The parts of a piece on the two sides of a plane; both have the same corners on it.
  static void divide(const Piece& piece, const Plane& plane, std::vector<Piece>& positive,
                     std::vector<Piece>& negative) {
    Piece above{piece.id, {}, piece.plane}, below{piece.id, {}, piece.plane};
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
      const Point &a = piece.corners[i], &b = piece.corners[(i + 1) % piece.corners.size()];
      const auto va = Arithmetic::side(plane, a), vb = Arithmetic::side(plane, b);
      if (va >= 0) above.corners.push_back(a);
      if (va <= 0) below.corners.push_back(a);
      if ((va > 0 && vb < 0) || (va < 0 && vb > 0)) {
        const Point cut = Arithmetic::cut(plane, a, b);
        above.corners.push_back(cut);
        below.corners.push_back(cut);
      }
    }
    if (above.corners.size() >= 3) positive.push_back(std::move(above));
    if (below.corners.size() >= 3) negative.push_back(std::move(below));
  }

  std::unique_ptr<Node> tree_of(std::vector<Piece> pieces) {
    if (pieces.empty()) return nullptr;
    ++nodes_;
    auto node = std::make_unique<Node>(Node{pieces[0], nullptr, nullptr});
    std::vector<Piece> positive, negative;
    for (std::size_t i = 1; i < pieces.size(); ++i)
      divide(pieces[i], node->on.plane, positive, negative);
    node->positive = tree_of(std::move(positive));
    node->negative = tree_of(std::move(negative));
    return node;
  }

  static void paint(const Piece& piece, const Camera& camera, Sight& sight) {
    double left = camera.width, right = 0, top = camera.height, bottom = 0;
    for (const Point& corner : piece.corners) {
      const EyePoint p = Arithmetic::rounded(corner);
      const double x = camera.projection.fx * p[0] / p[2] + camera.projection.cx,
                   y = camera.projection.fy * p[1] / p[2] + camera.projection.cy;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
    // A pixel more on each side than rounding could need.
    const auto first = [](double from) {
      return static_cast<std::uint32_t>(std::max(0.0, std::floor(from) - 1));
    };
    const auto end = [](double to, std::uint32_t size) {
      return static_cast<std::uint32_t>(std::clamp(std::ceil(to) + 1, 0.0, double{1} * size));
    };
    for (std::uint32_t y = first(top); y < end(bottom, camera.height); ++y) {
      for (std::uint32_t x = first(left); x < end(right, camera.width); ++x) {
        if (Arithmetic::is_met_at(piece.corners, camera, x + 0.5, y + 0.5))
          sight.ids[std::size_t{y} * camera.width + x] = piece.id;
      }
    }
  }

  /// From behind to before, as seen from the eye at the origin.
  static void paint(const Node* node, const Camera& camera, Sight& sight) {
    if (node == nullptr) return;
    const bool eye_is_above = Arithmetic::side(node->on.plane, Arithmetic::point({0, 0, 0})) > 0;
    paint(eye_is_above ? node->negative.get() : node->positive.get(), camera, sight);
    paint(node->on, camera, sight);
    paint(eye_is_above ? node->positive.get() : node->negative.get(), camera, sight);
  }

  std::uint64_t nodes_ = 0;
  std::unique_ptr<Node> root_;
};

}  // namespace

Sight bsp_tree(const Scene& scene, const Camera& camera, TreeArithmetic arithmetic) {
  switch (arithmetic) {
    case TreeArithmetic::binary64:
      return Tree<InBinary64>(scene).seen_by(camera);
    case TreeArithmetic::exact_outlines:
      return Tree<WithExactOutlines>(scene).seen_by(camera);
    case TreeArithmetic::exact:
      return Tree<Exact>(scene).seen_by(camera);
  }
  throw std::logic_error("no such arithmetic");
}

}  // namespace fathom::studies
