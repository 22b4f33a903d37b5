#pragma once

#include <array>

#include "fathom/scene/camera.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Half the distance from 1 to the next binary64 number: the relative error of one rounding.
inline constexpr double unit_roundoff = 0x1p-53;

/// A mesh vertex in the image, with what is proved about it.
///
/// q is affine in the image over every triangle, and of two surfaces at a sample the nearer has the
/// greater q: 1/D under a perspective camera, −D under an orthographic one.
struct ImageVertex {
  double u, v;  // pixels
  double q;
  /// |u − exact u| and |v − exact v| are at most this; +∞ where nothing is known of the vertex
  /// (see is_usable).
  float position_error;
  /// |q − exact q| is at most this.
  float q_error;

  /// Certainly in front of the camera, and of a magnitude for which the bounds were derived.
  /// Otherwise u and v mean nothing, and q < 0 says that the vertex is certainly not in front.
  [[nodiscard]] bool is_usable() const { return position_error < 1; }
  [[nodiscard]] bool is_behind() const { return !is_usable() && q < 0; }
};

/// From the vertices of one object to the image.
class VertexTransform {
 public:
  VertexTransform(const Object& object, const Camera& camera);

  ImageVertex operator()(const MeshPoint& X) const;

  /// True only if no sample of the image is covered by a triangle with these corners, for the
  /// corners' sake: all of them behind the camera, or all beyond one side of the image.
  /// Meant for corners that are not usable; false means "not known".
  [[nodiscard]] bool misses_image(const std::array<MeshPoint, 3>& corners) const;

 private:
  using Row = std::array<double, 4>;

  /// U, V, W rounded, with bounds of their errors.
  struct Homogeneous {
    double U, V, W;
    double error_UV, error_W;
  };
  [[nodiscard]] Homogeneous homogeneous(const MeshPoint& X) const;
  [[nodiscard]] ImageVertex perspective_vertex(const MeshPoint& X) const;
  [[nodiscard]] ImageVertex orthographic_vertex(const MeshPoint& X) const;

  bool perspective_;
  /// False where an entry of the matrix is of a magnitude for which the bounds were not derived.
  bool usable_ = true;
  double last_u_, last_v_;  // the last samples of a row and of a column
  Row U_, V_, W_, D_;
  Row size_UV_;  // max(|U_|, |V_|), entry by entry
  Row size_W_, size_D_;
};

}  // namespace fathom
