#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/numeric/double_word.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// The points that a sample sees, in the frame of a mesh or in the world. The point of depth D on
/// the ray of the sample (u, v) is
///   perspective   O + D·(u·m₀ + v·m₁ + m₂)
///   orthographic  (O + u·m₀ + v·m₁) + D·m₂.
/// Entries are exact numbers (quotients of dyadics) rounded to double-words: a relative error of
/// at most epsilon<DoubleWord>, and of at most 2⁻⁵³ if only `hi` is taken.
struct Rays {
  /// m₀, m₁, m₂, O
  std::array<std::array<WordPair, 3>, 4> columns;
  /// Magnitudes of the entries.
  std::array<std::array<double, 3>, 4> sizes{};
};

/// An affine function of a mesh point with exact coefficients; the last is the constant.
struct ExactRow {
  std::array<Dyadic, 4> coefficients;
  /// The coefficients where all of them are binary64 numbers.
  std::optional<std::array<double, 4>> binary64;
  /// Each coefficient is 0 or a multiple of 2^(this).
  std::array<long, 4> last_bits{};

  ExactRow() = default;
  explicit ExactRow(std::array<Dyadic, 4> exact);
  /// n such that the value at every point whose coordinates are multiples of 2^(bits[k]) is a
  /// multiple of 2ⁿ.
  [[nodiscard]] long last_bit_at(const std::array<long, 3>& bits) const;
  /// The value at X where it is a double-word number and found to be one.
  [[nodiscard]] std::optional<WordPair> value_at(const MeshPoint& X) const;
};

/// How the meshes of an object lie to the camera; all that the channels need of it.
struct ObjectRays {
  ObjectRays(const Object& object, const Camera& camera);

  /// False where a number is of a magnitude for which no bound was derived, or where the placement
  /// flattens the mesh: then the object's channels are written from exact numbers.
  bool usable = false;
  Rays rays;
  /// Takes the normal of a triangle of the mesh to the world: the cofactors of the placement.
  /// Not set where the placement is the identity.
  bool placed_as_is = true;
  std::array<std::array<WordPair, 3>, 3> normal_matrix;
  std::array<std::array<double, 3>, 3> normal_sizes{};
  /// From the mesh to U, V and D, and to the world.
  std::array<ExactRow, 3> image_rows;
  std::array<ExactRow, 3> world_rows;
  /// At least |det| of the linear part of image_rows.
  double determinant = 0;
};

/// What the channels need of camera and scene; objects are prepared when first asked for, by any
/// thread.
class SceneRays {
 public:
  SceneRays(const TriangleSource& triangles, const Camera& camera);

  [[nodiscard]] const TriangleSource& triangles() const { return triangles_; }
  [[nodiscard]] bool perspective() const { return perspective_; }
  /// Bounds of the samples' coordinates.
  [[nodiscard]] double greatest_u() const { return greatest_u_; }
  [[nodiscard]] double greatest_v() const { return greatest_v_; }
  /// Rays in the world.
  [[nodiscard]] const ObjectRays& world() const { return world_; }
  [[nodiscard]] const ObjectRays& object(std::uint32_t number) const;

  /// x and y of the camera-frame point of depth 1 on the ray of (u, v), as k₀u + k₁v + k₂.
  [[nodiscard]] const std::array<std::array<WordPair, 3>, 2>& lens() const { return lens_; }
  /// 1 + X² + Y², where X and Y bound the sums of the magnitudes of the terms of lens();
  /// +∞ where it is not usable.
  [[nodiscard]] double lens_size() const { return lens_size_; }

 private:
  TriangleSource triangles_;
  const Camera& camera_;
  bool perspective_;
  double greatest_u_, greatest_v_;
  ObjectRays world_;
  std::array<std::array<WordPair, 3>, 2> lens_;
  double lens_size_;
  struct Slot {
    std::once_flag made;
    std::optional<ObjectRays> rays;
  };
  mutable std::deque<Slot> objects_;
};

}  // namespace fathom
