#pragma once

#include <array>
#include <optional>

#include "fathom/fast/pixels/surface_facts.h"
#include "fathom/fast/pixels/zero_proof.h"

namespace fathom::fast {

/// The values of a visible surface at a sample in double-words, with bounds; what several channels
/// need is computed when it is first asked for.
/// Needs    a usable surface.
class SurfaceValues {
 public:
  SurfaceValues(SurfaceFacts& surface, const ValueFrame& frame, const ImagePoint& s)
      : surface_(surface), frame_(frame), s_(s), zero_(surface, frame.image.perspective) {}

  const Certified<WordPair>& depth();
  Certified<WordPair> distance() { return frame_.wide.distance(depth(), frame_.rays, s_); }
  const Certified<WordPair>& position(std::size_t k);
  const Certified<WordPair>& weight(std::size_t k);

  /// The depth if it is known exactly: that of all three corners, or the binary32 or binary64
  /// number nearest to it.
  const std::optional<WordPair>& exact_depth();

  /// Whether world coordinate k or a weight is exactly 0; any certified value of it will do.
  bool position_is_zero(std::size_t k);
  bool weight_is_zero(const Certified<double>& narrow);
  bool weight_is_zero(std::size_t k);
  /// Whether what is interpolated between numbers at the corners that are multiples of 2^(bits) is
  /// exactly 0.
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
