#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/other_map.h"
#include "fathom/camera/camera.h"

namespace fathom::validation {

/// vtkImageDifference of two grey pictures, rows from the top: the thresholded error that VTK's own
/// regression tests compare with 10. Nothing where VTK is not built in.
std::optional<double> vtk_image_difference(const std::vector<std::uint8_t>& a,
                                           const std::vector<std::uint8_t>& b, std::uint32_t width);

// The usual substitute for a truth: an earlier picture and a chosen tolerance.

/// Whether a comparison sees that a map is not the earlier one.
struct GoldenVerdicts {
  /// vtkImageDifference of grey pictures of the depths, above the 10 that VTK's tests allow;
  /// nothing where VTK is not there.
  bool vtk = false, has_vtk = false;
  /// A structural similarity of less than 0.99.
  /// Source   [WBSS04], windows of 8 × 8 pixels, grey pictures of 8 bits.
  bool ssim = false;
  /// More than 1 % of the pixels differ by more than 1 % of the depth.
  bool one_percent = false;
};

GoldenVerdicts golden_verdicts(const attribution::OtherMap& before,
                               const attribution::OtherMap& after, const Camera& camera);

/// 8-bit grey levels, 255 the nearest surface of `range_of`, 1 the farthest, 0 background.
std::vector<std::uint8_t> grey_picture(const attribution::OtherMap& map,
                                       const attribution::OtherMap& range_of);

/// The mean structural similarity of two grey pictures.
double structural_similarity(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                             std::uint32_t width);

}  // namespace fathom::validation
