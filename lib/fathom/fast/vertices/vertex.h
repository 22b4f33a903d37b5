#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene.h"

namespace fathom::fast {

/// Vertices within this distance of the image's origin (in pixels) that lie exactly on the grid of
/// this step are recognised: edge functions of such vertices are computed without any error
/// (setup-inl.h).
inline constexpr double snap_step = 0x1p-8, snap_limit = 0x1p15;

/// A mesh vertex in the image, with proved bounds.
///
/// q is affine in the image over every triangle, and of two surfaces at a sample the nearer has the
/// greater q: 1/D for a perspective camera, −D for an orthographic one.
struct alignas(32) ImageVertex {
  double u, v;  // pixels
  double q;
  /// Two bounds, as the upper halves of their binary64 representations, rounded up: the upper half
  /// bounds the errors of u and v, the lower half the error of q.
  std::uint64_t errors;

  /// |u − exact u| and |v − exact v| are at most this; 0: u and v are exact multiples of snap_step;
  /// +∞ if nothing is known about the vertex (see is_usable()).
  [[nodiscard]] double position_error() const {
    return std::bit_cast<double>(errors & 0xFFFFFFFF00000000);
  }
  /// |q − exact q| is at most this.
  [[nodiscard]] double q_error() const { return std::bit_cast<double>(errors << 32); }

  /// Whether the vertex is certainly in front of the camera, with magnitudes for which the bounds
  /// were derived. Otherwise u and v are meaningless, and q < 0 means that the vertex is certainly
  /// not in front.
  [[nodiscard]] bool is_usable() const { return position_error() < 1; }
  [[nodiscard]] bool is_behind() const { return !is_usable() && q < 0; }
};

/// A bound as half of ImageVertex::errors: not less than `bound`, and at most 2⁻²⁰ of it greater.
inline std::uint64_t upper_half(double bound) {
  return (std::bit_cast<std::uint64_t>(bound) >> 32) + 1;
}

/// The affine map from an object's mesh to U, V, W (and D), rounded. Value: m₀x + m₁y + m₂z + m₃.
struct ImageRows {
  using Row = std::array<double, 4>;
  Row U, V, W, D;
  /// Magnitudes, for the bounds: max(|U|, |V|) entry by entry, |W|, |D|.
  Row size_UV, size_W, size_D;
};

/// A linear form at a vertex; its computed and exact values differ by at most `error`.
struct VertexForm {
  double value, error;
};

/// Transforms the vertices of one object to the image.
class VertexTransform {
 public:
  VertexTransform(const Object& object, const Camera& camera);

  /// `image` has room for all points. Vector instructions; the bounds hold for every kind of them.
  void operator()(std::span<const MeshPoint> points, ImageVertex* image) const;
  ImageVertex operator()(const MeshPoint& X) const;

  /// Returns true only if all corners are behind the camera, or all are beyond one side of the
  /// image, so that the triangle covers no point of the image. Meant for unusable corners; false
  /// means "unknown".
  [[nodiscard]] bool misses_image(const std::array<MeshPoint, 3>& corners) const;
  /// Forms that are negative at no point of the image, w and h being its width and height: W, U, wW
  /// − U, V, hW − V. Meaningless if the matrix makes every vertex unusable.
  [[nodiscard]] std::array<VertexForm, 5> forms_of_image(const MeshPoint& X) const;

  // For the vector code:
  [[nodiscard]] const ImageRows& rows() const { return rows_; }
  [[nodiscard]] bool is_perspective() const { return perspective_; }
  /// Whether X, whose bounds contain the multiples (u, v) of snap_step, lies exactly there. False
  /// means "unknown".
  [[nodiscard]] bool lies_exactly_at(const MeshPoint& X, double u, double v) const;

 private:
  /// U, V, W rounded, with bounds on their errors.
  struct Homogeneous {
    double U, V, W;
    double error_UV, error_W;
  };
  [[nodiscard]] Homogeneous homogeneous(const MeshPoint& X) const;

  bool perspective_;
  /// False if an entry of the matrix has a magnitude for which the bounds were not derived, or is
  /// not 0 but rounds to 0.
  bool usable_ = true;
  /// Whether the rounded entries are the exact ones.
  bool exact_ = false;
  double width_, height_;  // of the image
  ImageRows rows_;
};

}  // namespace fathom::fast

// Constants of the vertices' bounds; their derivations are where they are used (vertex.cpp,
// vertex_lanes.cpp). validation/proofs/vertices/vertex_*.gappa.in proves each.
namespace fathom::fast::vertex_bounds {

inline constexpr double affine_error = 6 * unit_roundoff<double>;
/// Relative error of U·(1/W), of 1/W, and of W where quotients by W have a bound.
inline constexpr double quotient_error = 3 * unit_roundoff<double>;
inline constexpr double reciprocal_error = unit_roundoff<double>;
inline constexpr double greatest_relative_error_of_W = 0x1p-20;
/// How often the errors of U and kW go into the linear form kW − U.
inline constexpr double missed_form = 1.5;
/// Relative slack of a bound: covers the roundings in its own evaluation (fewer than 2⁵ of them,
/// 2⁻⁴⁸) and the terms of second order named there (2⁻¹⁸).
inline constexpr double slack = 1 + 0x1p-15;
/// Absolute floor of every bound, above all effects of underflow: these are errors of 2⁻¹⁰⁷⁵ in U,
/// V, W or D, which divisions enlarge by at most 2¹⁵⁰.
inline constexpr double underflow_floor = 0x1p-100;

inline constexpr double least_W = 0x1p-60, greatest_W = 0x1p60;
inline constexpr double greatest_coordinate = 0x1p30;
inline constexpr double greatest_position_error = 0x1p-12;

}  // namespace fathom::fast::vertex_bounds

namespace fathom::fast {

/// Memory for vertices in the image, which objects take and give back.
class VertexMemory {
 public:
  using Vertices = std::unique_ptr<ImageVertex[]>;
  /// Room for `count` vertices, with unspecified content.
  Vertices take(std::size_t count);
  /// Releases them to the system if there is no memory for the list.
  void give_back(Vertices vertices, std::size_t count) noexcept;
  /// Releases all memory that is not taken to the system.
  void forget() { blocks_.clear(); }

 private:
  struct Block {
    Vertices vertices;
    std::size_t count;
  };
  std::vector<Block> blocks_;
};

/// One object with its vertices in the image.
struct ImageObject {
  /// For an object or a part of one; its first triangle is number `first_triangle` of the objects
  /// that are drawn together. Its number in the scene is the same, or `scene_numbers` has the
  /// numbers of all its triangles in the scene, and outlives the object.
  ImageObject(const Object& object, const Mesh& its_mesh, const Camera& camera,
              std::uint32_t first_triangle, VertexMemory* kept = nullptr,
              std::span<const std::uint32_t> scene_numbers = {});
  ~ImageObject();
  ImageObject(const ImageObject&) = delete;
  ImageObject& operator=(const ImageObject&) = delete;

  const Mesh& mesh;
  /// Number of its first triangle.
  std::uint32_t first_number;
  VertexTransform transform;
  /// One for each vertex of the mesh.
  std::unique_ptr<ImageVertex[]> vertices;
  /// Where the vertices are given back to; may be null.
  VertexMemory* kept;
  /// The numbers of its triangles in the scene; null if they are the same here.
  const std::uint32_t* scene_numbers;

  [[nodiscard]] std::uint32_t end_number() const {
    return first_number + static_cast<std::uint32_t>(mesh.triangles.size());
  }
  /// The number of a triangle in the scene, which tiles and the referee use.
  [[nodiscard]] std::uint32_t number_in_scene(std::uint32_t number) const {
    return scene_numbers ? scene_numbers[number - first_number] : number;
  }
};
/// The numbers of their triangles are consecutive.
using ImageObjects = std::deque<ImageObject>;

/// The object that a triangle belongs to.
const ImageObject& object_of(const ImageObjects& objects, std::uint32_t number);

}  // namespace fathom::fast
