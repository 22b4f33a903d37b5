#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/options.h"
#include "fathom/pipeline/output/output_merger.h"

/// JSON of the pipeline: the output merger's work in `pipeline trace` and `pipeline run
/// output-merger`, and the entry of a map in `render --engine pipeline --stats`.
namespace fathom::app {

/// A stored depth: {"code", "value"} if it is a code, else {"bits", "value"}. The value is the
/// number in [0, 1] that it represents, rounded once.
nlohmann::ordered_json stored_json(Storage storage, StoredDepth stored);

/// The number of [0, 1] that a stored depth represents, rounded once to binary64.
double stored_number(Storage storage, StoredDepth stored);

/// {"primitive", "pixel", "before", "fragment", "tests", "blend", "changes", "after"}
nlohmann::ordered_json merge_json(const pipeline::MergeStep& step, Storage storage);

/// "nearer", or the comparison as scene files spell it; "none" without a depth test.
const char* depth_test_name(const pipeline::MergeStep& step);

const char* comparison_name(Comparison comparison);
std::optional<Comparison> comparison_named(std::string_view name);

/// "passed", "depth test failed" or "stencil test failed"
const char* outcome_name(pipeline::Outcome outcome);

/// The entry of a map in `render --engine pipeline --stats`.
struct PipelineReport {
  std::string map;  ///< the name of the file
  std::uint32_t width = 0, height = 0;
  pipeline::PipelineStatistics statistics;
  std::optional<pipeline::PainterStatistics> painter;
};

/// An object for a single map, a list for several.
std::string as_json(const std::vector<PipelineReport>& maps);

/// Warns about a viewport that stretches the picture, and about windows that contain no pixel of
/// the image.
void warn_of_windows(const Camera& camera, const pipeline::PipelineOptions& stages,
                     const Console& console);

}  // namespace fathom::app
