#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/textbook/cases/case_reading.h"
#include "fathom/pipeline/options.h"
#include "fathom/pipeline/trace.h"

/// `fathom pipeline run STAGE`: one stage of the pipeline by itself. A record goes in, and comes
/// out with the stage's results, so that the answer of a stage is the case of the next one.
namespace fathom::app {

struct StageDescription {
  std::string name, takes, adds;
};
/// In the order of the data.
const std::vector<StageDescription>& pipeline_stages();

/// The record after a stage, computed in a precision.
/// Fails    InputError: the record lacks something, or cannot be used; UsageError for a stage that
///          does not exist.
cases::Json run_stage(const std::string& stage, const cases::Json& record,
                      pipeline::Precision precision);

/// What goes into each stage of the pipeline and what comes out.
std::string as_text(const pipeline::PrimitiveTrace& trace);
nlohmann::ordered_json to_json(const pipeline::PrimitiveTrace& trace);

}  // namespace fathom::app
