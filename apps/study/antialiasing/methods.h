#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/study/study.h"
#include "fathom/pipeline/output/output_merger.h"

/// Pictures by every kind of antialiasing that the pipeline has, against exact areas.
namespace fathom::studies {

/// How far a picture is from the exact one: differences of colour, 1 from black to white, as means
/// of the three components.
struct PictureError {
  double mean = 0, rms = 0, greatest = 0;
};
PictureError error_of(const pipeline::ColourImage& image, const pipeline::ColourImage& truth);

struct MethodError {
  std::string name;
  PictureError star, sheets;
  /// Of the checkered plane and wall, and of letters that are right without antialiasing.
  PictureError plane, wall, text;
  double ms = 0;             ///< for the star, here: the least of several frames
  std::uint64_t shaded = 0;  ///< for the star
  /// The peak of the memory that a frame of 192 × 192 pixels takes here, for each pixel; nullopt
  /// where the system does not measure it.
  std::optional<double> bytes_a_pixel;
};

struct FilterError {
  std::string filter;
  double mean = 0;  ///< of the checkered plane, one sample a pixel
};

struct AntialiasingMethods {
  std::vector<MethodError> methods;
  std::vector<FilterError> filters;
  /// Of the checkered wall, in which no edge of a triangle is seen: the share of pixels that FXAA
  /// changes all the same.
  double texture_changed_by_fxaa = 0;
  /// star-METHOD, sheets-METHOD, filter-FILTER, wall-, text- and plane-truth, …, each with the
  /// width in which it is shown.
  std::vector<std::pair<StudyFile, std::uint32_t>> pictures;
  std::vector<StudyFile> files;  ///< the scenes and cameras that they are drawn from
};

/// All of them as the pipeline is by default: binary32, and 8 subpixel bits unless the name says
/// others.
AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick);

}  // namespace fathom::studies
