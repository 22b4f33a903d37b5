#include "validation/studies/hidden_surface/bsp_tree.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fathom/image/depth_map.h"

namespace fathom::studies {
namespace {

/// Of a triangle, whose plane it keeps: a sliver's own corners tell no plane.
struct Piece {
  std::uint32_t id;
  EyePolygon corners;
  EyePlane plane;
};

struct Node {
  EyePlane plane;
  std::vector<Piece> on;
  std::unique_ptr<Node> positive, negative;
};

/// The parts of a piece on the two sides of a plane; both have the same corners on it.
void divide(const Piece& piece, const EyePlane& plane, std::vector<Piece>& positive,
            std::vector<Piece>& negative) {
  Piece above{piece.id, {}, piece.plane}, below{piece.id, {}, piece.plane};
  for (std::size_t i = 0; i < piece.corners.size(); ++i) {
    const EyePoint &a = piece.corners[i], &b = piece.corners[(i + 1) % piece.corners.size()];
    const double va = plane.at(a), vb = plane.at(b);
    if (va >= 0) above.corners.push_back(a);
    if (va <= 0) below.corners.push_back(a);
    if ((va > 0 && vb < 0) || (va < 0 && vb > 0)) {
      const double t = va / (va - vb);
      const EyePoint cut{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]),
                         a[2] + t * (b[2] - a[2])};
      above.corners.push_back(cut);
      below.corners.push_back(cut);
    }
  }
  if (above.corners.size() >= 3) positive.push_back(std::move(above));
  if (below.corners.size() >= 3) negative.push_back(std::move(below));
}

std::unique_ptr<Node> tree_of(std::vector<Piece> pieces, Sight& sight) {
  if (pieces.empty()) return nullptr;
  ++sight.steps;
  auto node = std::make_unique<Node>();
  node->plane = pieces[0].plane;
  node->on.push_back(pieces[0]);
  std::vector<Piece> positive, negative;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    divide(pieces[i], node->plane, positive, negative);
  }
  ++sight.polygons;
  node->positive = tree_of(std::move(positive), sight);
  node->negative = tree_of(std::move(negative), sight);
  return node;
}

void paint(const Piece& piece, const Camera& camera, Sight& sight) {
  double left = camera.width, right = 0, top = camera.height, bottom = 0;
  for (const EyePoint& p : piece.corners) {
    const double x = camera.fx * p[0] / p[2] + camera.cx, y = camera.fy * p[1] / p[2] + camera.cy;
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
      if (is_met(piece.corners, ray_at(camera, x + 0.5, y + 0.5))) {
        sight.ids[std::size_t{y} * camera.width + x] = piece.id;
      }
    }
  }
}

/// From behind to before, as seen from the eye at the origin.
void paint(const Node* node, const Camera& camera, Sight& sight) {
  if (node == nullptr) return;
  const bool eye_is_above = node->plane.at({0, 0, 0}) > 0;
  paint(eye_is_above ? node->negative.get() : node->positive.get(), camera, sight);
  for (const Piece& piece : node->on) paint(piece, camera, sight);
  paint(eye_is_above ? node->positive.get() : node->negative.get(), camera, sight);
}

}  // namespace

Sight bsp_tree(const Scene& scene, const Camera& camera) {
  Sight sight;
  sight.ids.assign(std::size_t{camera.width} * camera.height, no_surface);
  std::vector<Piece> pieces;
  for (EyePolygon& p : eye_polygons(scene)) {
    const EyePlane plane = plane_of(p);
    pieces.push_back({static_cast<std::uint32_t>(pieces.size()), std::move(p), plane});
  }
  const std::unique_ptr<Node> root = tree_of(std::move(pieces), sight);
  paint(root.get(), camera, sight);
  return sight;
}

}  // namespace fathom::studies
