#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace fathom::validation {

/// vtkImageDifference of two grey pictures, rows from the top: the thresholded error that VTK's own
/// regression tests compare with 10. Nothing where VTK is not built in.
std::optional<double> vtk_image_difference(const std::vector<std::uint8_t>& a,
                                           const std::vector<std::uint8_t>& b, std::uint32_t width);

}  // namespace fathom::validation
