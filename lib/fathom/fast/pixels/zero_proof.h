#pragma once

#include <array>
#include <optional>

#include "fathom/fast/pixels/surface_facts.h"

namespace fathom::fast {

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

}  // namespace fathom::fast
