#include "fathom/camera/camera_import.h"

#include <fmt/core.h>

#include <algorithm>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom {
namespace {

constexpr const char* what_to_do =
    "undistort the images and take the cameras of the result, or take the pinhole part with "
    "--ignore-distortion (ignore_distortion in Python)";

/// Why there is no camera to take. A fisheye has no pinhole part.
std::string absence_of(const ImportedCamera& one, const CameraChoice& choice) {
  const auto& lens = one.camera.projection.lens;
  if (!choice.ignore_distortion || !lens || has_pinhole_part(lens->model)) return one.absence;
  return fmt::format("{}: the lens {} has no pinhole part to take", one.camera.name,
                     name_of(lens->model));
}

void require_camera(const ImportedCamera& one, const CameraChoice& choice) {
  for (const std::string& reason : {one.fault, absence_of(one, choice)})
    if (!reason.empty()) throw InputError(reason);
}

/// The cameras that a choice leaves out: their number, and why the first is left out.
struct LeftOut {
  std::size_t count = 0;
  std::string first;

  void add(const std::string& reason) {
    if (count++ == 0) first = reason;
  }
};

Camera chosen(Camera camera, const CameraChoice& choice) {
  if (choice.ignore_distortion) camera.projection.lens.reset();
  return camera;
}

Camera the_one_of(const std::vector<ImportedCamera>& imported, const std::string& input,
                  const CameraChoice& choice) {
  const auto found = std::ranges::find_if(
      imported, [&](const ImportedCamera& one) { return one.camera.name == choice.image; });
  if (found == imported.end()) {
    throw InputError(fmt::format("{}: no image '{}'; --list shows the {} there are", input,
                                 text::printable(choice.image), imported.size()));
  }
  require_camera(*found, choice);
  if (!found->distortion.empty() && !choice.ignore_distortion) {
    throw InputError(found->distortion + "; " + what_to_do);
  }
  return chosen(found->camera, choice);
}

/// "1 of 2 cameras has lens distortion and is left out: …"
std::string of_all(const LeftOut& left_out, std::size_t all, const char* have = "",
                   const char* has = "") {
  const bool is_one = left_out.count == 1;
  return fmt::format("{} of {} {}{} left out: {}", left_out.count, text::counted(all, "camera"),
                     is_one ? has : have, is_one ? "is" : "are", left_out.first);
}

}  // namespace

std::vector<Camera> chosen_cameras(const std::vector<ImportedCamera>& imported,
                                   const std::string& input, const CameraChoice& choice,
                                   Warnings& warnings) {
  const StandardArithmetic standard;
  if (imported.empty()) throw InputError(input + ": holds no camera");
  if (!choice.image.empty()) return {the_one_of(imported, input, choice)};
  std::vector<Camera> cameras;
  LeftOut distorted, absent;
  for (const ImportedCamera& one : imported) {
    if (const std::string absence = absence_of(one, choice); !absence.empty()) {
      absent.add(absence);
    } else if (!one.distortion.empty() && !choice.ignore_distortion) {
      distorted.add(one.distortion);
    } else {
      require_camera(one, choice);
      cameras.push_back(chosen(one.camera, choice));
    }
  }
  if (cameras.empty()) {
    throw InputError(distorted.count != 0 ? distorted.first + "; " + what_to_do : absent.first);
  }
  if (distorted.count != 0) {
    const std::string left_out =
        of_all(distorted, imported.size(), "have lens distortion and ", "has lens distortion and ");
    warnings.push_back(left_out + "; " + what_to_do);
  }
  if (absent.count != 0) warnings.push_back(of_all(absent, imported.size()));
  return cameras;
}

}  // namespace fathom
