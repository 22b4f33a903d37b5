#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/surface_points.h"
#include "fathom/numeric/certified_arithmetic.h"
#include "fathom/rendering/options.h"

namespace fathom::evaluation {

/// Decides which points of a surface a camera sees. The scene and its parts must outlive it.
///
/// A camera sees a point of a triangle that it does not see edge on and that culling keeps if the
/// point's image lies in the closed rectangle of the image, its depth is above 0 and from near to
/// far, and no other such triangle, its edges included, has a smaller depth in that range there.
/// This is the specification's rule for a sample, except that edges hide on both sides: points are
/// not on a grid, so nothing has to be covered exactly once.
/// Exact    every decision: by binary64 with bounds, and by exact numbers if the bounds do not
///          settle it.
class PointSight {
 public:
  PointSight(const TriangleSource& source, const PlacedTriangles& triangles, const BoxTree& tree,
             const Camera& camera, Cull cull);

  /// `p` is the point of the triangle.
  [[nodiscard]] bool sees(std::uint32_t triangle, const PlacedPoint& p) const;

 private:
  using Number = Certified<double>;
  /// A point in the camera's frame, in the unit of the triangles.
  struct View {
    Number x, y, z;
  };
  /// Its image before the lens: (x, y, W), of which the image is K·(x, y, W), in that unit too.
  using Image = std::array<Number, 3>;
  /// The point and what stands between it and the camera.
  struct Line;

  [[nodiscard]] View view_of(const Vector& near, double error) const;
  [[nodiscard]] Image image_of(const View& view) const;
  [[nodiscard]] bool is_in_image(const PlacedPoint& p, const View& view) const;
  [[nodiscard]] bool is_in_range(const PlacedPoint& p, const View& view) const;
  [[nodiscard]] bool shows_a_side(std::uint32_t triangle) const;
  [[nodiscard]] Line line_to(const PlacedPoint& p) const;
  [[nodiscard]] bool hides(std::uint32_t number, const PlacedPoint& p, const View& view) const;
  [[nodiscard]] std::optional<bool> hides_certainly(std::uint32_t number, const View& view) const;
  [[nodiscard]] bool hides_exactly(std::uint32_t number, const PlacedPoint& p) const;
  [[nodiscard]] bool is_hidden(std::uint32_t triangle, const PlacedPoint& p,
                               const View& view) const;
  /// Of a triangle whose Δ in the camera's frame has this sign.
  [[nodiscard]] bool is_kept(Sign turn) const;

  const TriangleSource& source_;
  const PlacedTriangles& triangles_;
  const BoxTree& tree_;
  const Camera& camera_;
  Cull cull_;
  /// [R | t] and near in the unit of the triangles.
  std::array<std::array<Number, 4>, 3> pose_;
  Number near_;
  /// W of every point of an orthographic camera: 1, in that unit.
  Number one_;
  /// The sign of det K.
  Sign lens_;
  /// Where the camera is, in that unit; of an orthographic one the way to it. Rounded.
  Vector eye_;
};

}  // namespace fathom::evaluation
