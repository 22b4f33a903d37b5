#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/recorded_depth.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A storage that all depths of a map fit in.
struct CoarseStorage {
  RecordedDepth recorded;
  /// "multiples of 0.001", "16 bits between near and far", …
  std::string text;
};

/// The coarsest storage, coarser than the model's own, that fits all surfaces of a map: half
/// floats, multiples of a common step, codes of depth or window depth between near and far.
/// Exact    a value fits a storage if it is within four roundings to binary32 of a stored value,
///          and stored values are at least 16 times as far apart. All values must fit, and there
///          must be so many that chance suggests a wrong storage at most once in 2²⁰ maps.
/// Source   16 bits in millimetres and the like: docs/validation.md, "Findings".
std::optional<CoarseStorage> coarse_storage(const Camera& camera, const OtherMap& other,
                                            const RendererModel& model);

/// Whether depths were rounded down to the storage's steps rather than to nearest, on the whole.
bool is_rounded_down(const Truth& truth, const OtherMap& other, const RecordedDepth& recorded);

/// A lattice through all of the values, the coarsest that there is: origin 0.
std::optional<double> common_step(const std::vector<double>& values);

}  // namespace fathom::attribution
