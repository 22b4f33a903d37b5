#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "fathom/camera/camera.h"

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

/// The step of the coarsest lattice with origin 0 that contains all values.
std::optional<double> common_step(const std::vector<double>& values);

/// Depths, in scene units.
struct ClipPlanes {
  double near = 0, far = 0;
};

/// A positive value, rounded to so many significant decimal digits.
double rounded_to_digits(double value, int digits);

/// The near and far between which a map's window depths were stored, if the camera's differ.
///
/// Source   a window depth of n bits is the code k of 1/D = 1/near − k·(1/near − 1/far)/(2ⁿ − 1),
///          so the inverse depths of a map lie on a lattice. Its step and its phase give near and
///          far, if near has at most three digits and far is the camera's or has at most two.
/// Exact    a depth fits if 1/D is within four roundings to binary32 of a code. All depths must
///          fit, the codes must be at least 16 times as far apart, and there must be so many depths
///          that chance gives a map such a lattice at most once in 2²⁰ maps.
/// Needs    a perspective camera and a model of OpenGL's window depths in 16, 24 or 32 bits; else
///          nothing.
std::optional<ClipPlanes> stored_planes(const Camera& camera, const OtherMap& other,
                                        const RendererModel& model);

}  // namespace fathom::attribution
