#include "fathom/camera/camera_import.h"

#include <fmt/core.h>

#include <algorithm>

#include "fathom/numeric/errors.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom {
namespace {

constexpr const char* what_to_do =
    "undistort the images and take the cameras of the result, or take the pinhole part with "
    "--ignore-distortion (ignore_distortion in Python)";

void require_usable(const ImportedCamera& one) {
  if (!one.fault.empty()) throw InputError(one.fault);
}

Camera the_one_of(const std::vector<ImportedCamera>& imported, const std::string& input,
                  const CameraChoice& choice) {
  const auto found = std::ranges::find_if(
      imported, [&](const ImportedCamera& one) { return one.camera.name == choice.image; });
  if (found == imported.end()) {
    throw InputError(fmt::format("{}: no image '{}'; --list shows the {} there are", input,
                                 text::printable(choice.image), imported.size()));
  }
  require_usable(*found);
  if (!found->distortion.empty() && !choice.ignore_distortion) {
    throw InputError(found->distortion + "; " + what_to_do);
  }
  return found->camera;
}

}  // namespace

std::vector<Camera> chosen_cameras(const std::vector<ImportedCamera>& imported,
                                   const std::string& input, const CameraChoice& choice,
                                   Warnings& warnings) {
  if (imported.empty()) throw InputError(input + ": holds no camera");
  if (!choice.image.empty()) return {the_one_of(imported, input, choice)};
  std::vector<Camera> cameras;
  const ImportedCamera* distorted = nullptr;
  std::size_t left_out = 0;
  for (const ImportedCamera& one : imported) {
    if (!one.distortion.empty() && !choice.ignore_distortion) {
      if (left_out++ == 0) distorted = &one;
      continue;
    }
    require_usable(one);
    cameras.push_back(one.camera);
  }
  if (cameras.empty()) throw InputError(distorted->distortion + "; " + what_to_do);
  if (left_out != 0) {
    warnings.push_back(fmt::format("{} of {} {} lens distortion and {} left out: {}; {}", left_out,
                                   text::counted(imported.size(), "camera"),
                                   left_out == 1 ? "has" : "have", left_out == 1 ? "is" : "are",
                                   distorted->distortion, what_to_do));
  }
  return cameras;
}

}  // namespace fathom
