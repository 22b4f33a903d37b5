#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/triangle/certified_surface.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/rays.h"

namespace fathom::fast {

/// The data from which the values of all surfaces are computed.
struct ValueFrame {
  explicit ValueFrame(const triangle::SceneRays& its_rays);

  const triangle::SceneRays& rays;
  const triangle::WideArithmetic& wide;
  triangle::ImageBounds image;
  triangle::RaySizes world_sizes;
};

/// The normals of a triangle's corners in the world, prepared for interpolation: the normal of A,
/// and the normals of B and C minus it.
struct SurfaceNormals {
  Vector<Certified<double>> at_A, to_B, to_C;
};

/// A visible triangle, with all results about it so far. Functions store further results here.
struct SurfaceFacts {
  /// False if a number has a magnitude for which no bound was derived: only exact numbers will do.
  bool usable = false;
  TriangleOrigin origin;
  const triangle::ObjectRays* object = nullptr;
  triangle::MeshTriangle corners;

  std::optional<triangle::WeightForms<double>> weights;
  std::optional<triangle::DepthForms<WordPair>> depth;
  /// The normals as they are written, in the world and in the camera frame.
  std::optional<std::array<float, 3>> normal, camera_normal;
  std::optional<SurfaceNormals> corner_normals;
  /// Exponents of powers of two of which the components of these are multiples.
  std::optional<std::array<long, 3>> normal_bits;
  /// World x, y, z and depth, if they are found to be the same at all three corners; bit k of
  /// constants_known is set once constants[k] has been checked.
  std::array<std::optional<WordPair>, 4> constants;
  std::uint8_t constants_known = 0;
};

/// A triangle of the scene, without further results.
SurfaceFacts surface_facts(std::uint32_t number, const ValueFrame& frame);

const triangle::WeightForms<double>& weights_of(SurfaceFacts& t, const ValueFrame& frame);
const triangle::DepthForms<WordPair>& depth_of(SurfaceFacts& t, const ValueFrame& frame);

/// World coordinate k, or the depth (3), if it is found to be the same number at all corners.
const std::optional<WordPair>& constant_of(SurfaceFacts& t, std::size_t k);

/// Proves that a value of a surface at a sample is exactly 0, which no bound on its error can.
///
/// At a sample every interpolated value is Σ eᵢ·xᵢ / Σ eᵢ. The coordinates of the corners are
/// multiples of some powers of two, and so are U, V, W, the edge functions eᵢ and the numerator;
/// Σ eᵢ = det(H)·(n·d) up to its sign (triangle/certified_surface.h). So |value|·|det H|·|n·d| is
/// |numerator|, and if an upper bound on it is below the power of two of which the numerator is a
/// multiple, the value is 0.
class ZeroProof {
 public:
  ZeroProof(const SurfaceFacts& surface, bool perspective)
      : surface_(surface), perspective_(perspective) {}

  /// Exponents of powers of two of which these are multiples: a world coordinate (k = 0, 1, 2) or
  /// U, V, D of the corners; the edge functions, which are determinants of two corners and a
  /// sample.
  long world_bits(std::size_t k);
  long image_bits(std::size_t k);
  long weight_bits();

  /// From upper bounds on |value| and |n·d|, and an exponent for the numerator.
  [[nodiscard]] bool holds(double value, double divisor, long numerator_bits) const;
  /// At the sample s, where n·d is the divisor of the depth.
  [[nodiscard]] bool holds(const Certified<WordPair>& value,
                           const triangle::DepthForms<WordPair>& depth, const ImagePoint& s,
                           long numerator_bits) const;

 private:
  /// Of the corners' x, y and z.
  const std::array<long, 3>& corner_bits();

  const SurfaceFacts& surface_;
  bool perspective_;
  std::optional<std::array<long, 3>> corner_bits_;
};

/// The values of a visible surface at a sample in double-words, with bounds; values that several
/// channels need are computed on first use.
/// Needs    a usable surface.
class SurfaceValues {
 public:
  SurfaceValues(SurfaceFacts& surface, const ValueFrame& frame, const ImagePoint& s)
      : surface_(surface), frame_(frame), s_(s), zero_(surface, frame.image.perspective) {}

  const Certified<WordPair>& depth();
  Certified<WordPair> distance() { return frame_.wide.distance(depth(), frame_.rays, s_); }
  const Certified<WordPair>& position(std::size_t k);
  const Certified<WordPair>& weight(std::size_t k);

  /// The depth if it is known exactly: the depth of all three corners, or the binary32 or binary64
  /// number nearest to it.
  const std::optional<WordPair>& exact_depth();

  /// Whether world coordinate k or a weight is exactly 0; any certified value of it will do.
  bool position_is_zero(std::size_t k);
  bool weight_is_zero(const Certified<double>& narrow);
  bool weight_is_zero(std::size_t k);
  /// Whether an interpolated value is exactly 0, if the numbers at the corners are multiples of
  /// 2^(bits).
  bool interpolated_is_zero(const Certified<double>& narrow, long bits);

 private:
  bool is_zero(const Certified<WordPair>& value, long numerator_bits);

  SurfaceFacts& surface_;
  const ValueFrame& frame_;
  ImagePoint s_;
  ZeroProof zero_;
  std::optional<Certified<WordPair>> depth_;
  std::optional<Vector<Certified<WordPair>>> position_;
  std::optional<std::array<Certified<WordPair>, 2>> weights_;
  bool looked_for_exact_depth_ = false;
  std::optional<WordPair> exact_depth_;
};

}  // namespace fathom::fast
