#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fathom {

/// Where a sample is in its pixel: from the centre, u to the right and v down, in pixels. Exact
/// binary fractions.
using SampleOffset = std::array<double, 2>;

/// Several samples per pixel (specification, section 5).
///
///   1, 2, 4, 8, 16   the standard positions of Direct3D and Vulkan, multiples of 1/16
///   rotated-grid     four samples, the regular 2×2 grid turned by arctan ½ and enlarged by √5/2
///   regular:N        N×N at (i + ½)/N − ½
///   jittered:N       one sample in each of N×N cells, drawn for every pixel from the seed, the
///   jittered:N:SEED  cell and the pixel; multiples of 2⁻¹⁶ of a cell. SEED is 1 unless given
///
/// N is 1, 2, 4, 8 or 16, so that offsets are binary fractions.
struct SamplePattern {
  std::string name;
  /// For a jittered pattern, the top left corners of the cells.
  std::vector<SampleOffset> offsets;
  bool jittered = false;
  double cell = 1;  ///< side of a cell of a jittered pattern
  std::uint64_t seed = 1;

  [[nodiscard]] std::size_t count() const { return offsets.size(); }
  /// The k-th sample's offset at a pixel.
  [[nodiscard]] SampleOffset at(std::size_t k, std::uint32_t column, std::uint32_t row) const;
};

/// Refuses a pattern that sample_pattern() does not make: no samples, more than 256 of them, or a
/// sample that is not within half a pixel of the centre.
/// Fails    UsageError.
void require_valid(const SamplePattern& pattern);

/// Fails    UsageError, naming the patterns that exist.
SamplePattern sample_pattern(const std::string& name);

}  // namespace fathom
