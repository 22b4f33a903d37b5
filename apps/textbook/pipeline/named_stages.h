#pragma once

#include <vector>

#include "apps/textbook/pipeline/stage_cases.h"

/// The stages of `fathom pipeline run`, as functions from record to record: each returns the record
/// with its results (stage_cases.h).
namespace fathom::app::stages {

using Stage = cases::Json (*)(cases::Json record, pipeline::Precision precision);

/// A stage, computed in either precision.
struct NamedStage {
  StageDescription description;
  Stage binary32, binary64;
};

/// From primitive assembly to the viewport.
std::vector<NamedStage> geometry_stages();

/// Scan conversion and the output merger.
std::vector<NamedStage> fragment_stages();

}  // namespace fathom::app::stages
