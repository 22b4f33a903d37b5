#include <vtkImageData.h>
#include <vtkImageDifference.h>
#include <vtkNew.h>

#include "apps/validate/faults/golden_image.h"

namespace fathom::validation {
namespace {

vtkNew<vtkImageData> colours_of(const std::vector<std::uint8_t>& grey, std::uint32_t width) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(width), static_cast<int>(grey.size() / width), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* out = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (const std::uint8_t level : grey) {
    for (int channel = 0; channel < 3; ++channel) *out++ = level;
  }
  return image;
}

}  // namespace

std::optional<double> vtk_image_difference(const std::vector<std::uint8_t>& a,
                                           const std::vector<std::uint8_t>& b,
                                           std::uint32_t width) {
  vtkNew<vtkImageDifference> difference;
  difference->SetInputData(colours_of(a, width));
  difference->SetImageData(colours_of(b, width));
  difference->Update();
  return difference->GetThresholdedError();
}

}  // namespace fathom::validation
