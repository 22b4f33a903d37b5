#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/studies/study.h"

/// Pictures by every kind of antialiasing that the pipeline has, against exact areas.
namespace fathom::studies {

struct MethodError {
  std::string name;
  double mean = 0, rms = 0, greatest = 0;  ///< against exact areas, of full white
  double texture_mean = 0;                 ///< of a textured plane, against 16 × 16 samples
  double ms = 0, megabytes = 0;            ///< here; of the samples that are kept
  std::uint64_t shaded = 0;
};

struct FilterError {
  std::string filter;
  double mean = 0;  ///< of the textured plane, against 16 × 16 samples
};

struct AntialiasingMethods {
  std::vector<MethodError> methods;
  std::vector<FilterError> filters;
  /// Of a texture that fills the picture, without an edge of any triangle: the share of pixels that
  /// FXAA changes all the same.
  double texture_changed_by_fxaa = 0;
  /// star-METHOD, plane-FILTER and plane-truth, texture-none and texture-fxaa.
  std::vector<StudyFile> pictures;
};

AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick);

}  // namespace fathom::studies
