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

namespace fathom::triangle {

/// The points on the ray of a sample, in the frame of a mesh or in the world. The point of depth D
/// on the ray of the sample (u, v) is
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

/// An affine function of a mesh point with exact coefficients; the last one is the constant.
struct ExactRow {
  std::array<Dyadic, 4> coefficients;
  /// The coefficients, if all of them are binary64 numbers.
  std::optional<std::array<double, 4>> binary64;
  /// Each coefficient is 0 or a multiple of 2^(this).
  std::array<long, 4> last_bits{};

  ExactRow() = default;
  explicit ExactRow(std::array<Dyadic, 4> exact);
  /// n such that the value at every point whose coordinates are multiples of 2^(bits[k]) is a
  /// multiple of 2ⁿ.
  [[nodiscard]] long last_bit_at(const std::array<long, 3>& bits) const;
  /// The value at X, if it is found to be a double-word number.
  [[nodiscard]] std::optional<WordPair> value_at(const MeshPoint& X) const;
};

/// Transforms normals from one frame to another: cofactors of a linear map, exact numbers rounded
/// to double-words, and their magnitudes.
struct NormalMatrix {
  std::array<std::array<WordPair, 3>, 3> rows;
  std::array<std::array<double, 3>, 3> sizes{};
};

/// The position of an object's mesh relative to the camera, as the channels need it.
struct ObjectRays {
  ObjectRays(const Object& object, const Camera& camera);

  /// False if a number has a magnitude for which no bound was derived, or if the placement flattens
  /// the mesh: then the object's channels are written from exact numbers.
  bool usable = false;
  Rays rays;
  /// From the mesh to the world: the cofactors of the placement. Not set if the placement is the
  /// identity.
  bool placed_as_is = true;
  NormalMatrix to_world;
  /// Whether the determinant of the placement is below 0.
  bool mirrored = false;
  /// From the mesh to the camera frame, by the cofactors of R times the placement; only where
  /// camera_normals_usable.
  NormalMatrix to_camera;
  bool camera_normals_usable = false;
  /// From the mesh to U, V and D, and to the world.
  std::array<ExactRow, 3> image_rows;
  std::array<ExactRow, 3> world_rows;
  /// At least |det| of the linear part of image_rows.
  double determinant = 0;
};

/// The data of camera and scene that the channels need; an object is prepared on its first use, by
/// any thread.
class SceneRays {
 public:
  SceneRays(const TriangleSource& triangles, const Camera& camera);

  [[nodiscard]] const TriangleSource& triangles() const { return triangles_; }
  [[nodiscard]] bool perspective() const { return perspective_; }
  /// Upper bounds on the samples' coordinates, in pixels.
  [[nodiscard]] double greatest_u() const { return greatest_u_; }
  [[nodiscard]] double greatest_v() const { return greatest_v_; }
  /// The sign of det R.
  [[nodiscard]] Sign handedness() const { return handedness_; }
  /// Rays in the world.
  [[nodiscard]] const ObjectRays& world() const { return world_; }
  [[nodiscard]] const ObjectRays& object(std::uint32_t number) const;

  /// x and y of the camera-frame point of depth 1 on the ray of (u, v), as k₀u + k₁v + k₂.
  [[nodiscard]] const std::array<std::array<WordPair, 3>, 2>& lens() const { return lens_; }
  /// 1 + X² + Y², where X and Y bound the sums of the magnitudes of the terms of lens(); +∞ if it
  /// is not usable.
  [[nodiscard]] double lens_size() const { return lens_size_; }

 private:
  TriangleSource triangles_;
  const Camera& camera_;
  bool perspective_;
  double greatest_u_, greatest_v_;
  Sign handedness_;
  ObjectRays world_;
  std::array<std::array<WordPair, 3>, 2> lens_;
  double lens_size_;
  struct Slot {
    std::once_flag made;
    std::optional<ObjectRays> rays;
  };
  mutable std::deque<Slot> objects_;
};

}  // namespace fathom::triangle
