#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "fathom/depth_format/depth_format.h"
#include "validation/studies/page.h"
#include "validation/studies/study.h"

/// The part of the study `z-fighting` in which the angle is swept: how far the two surfaces are
/// tilted from facing the camera.
namespace fathom::studies {

struct FightByAngle {
  DepthFormat format;
  double degrees, distance;
  /// Share of samples where the wrong surface wins; premultiplied: in the pipeline model, NaN where
  /// the mapping is no projection.
  double ideal, premultiplied;
  double safe, predicted;  ///< least safe separation
};

struct AngleSweep {
  double near, far, separation;
  int samples;
  /// At each of which every angle is measured.
  std::vector<double> distances;
};

/// From 0 to 55 degrees, in four formats.
std::vector<FightByAngle> fights_by_angle(const AngleSweep& sweep);

/// angles.csv and the plots `angle-share` and `angle-safe`.
std::vector<StudyFile> files_of(const std::vector<FightByAngle>& fights, const AngleSweep& sweep);

nlohmann::ordered_json json_of(const std::vector<FightByAngle>& fights);

void add_to_page(const std::vector<FightByAngle>& fights, Page& page);

}  // namespace fathom::studies
