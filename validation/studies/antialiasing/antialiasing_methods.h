#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "validation/studies/page.h"
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
  std::vector<StudyFile> pictures;
};

AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick);

void add_to_summary(const AntialiasingMethods& measured, nlohmann::ordered_json& summary);
void add_to_page(const AntialiasingMethods& measured, Page& page);
/// methods.csv, the pictures, and the plot of what frequency a grating seems to have.
std::vector<StudyFile> files_of(const AntialiasingMethods& measured);

}  // namespace fathom::studies
