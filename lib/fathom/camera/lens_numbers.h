#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "fathom/camera/lens.h"

/// Lenses from the name of a model and a list of numbers: the same checks for camera files,
/// importers, the program and C.
namespace fathom {

/// "unknown lens model 'OPENC', expected …; did you mean 'OPENCV'?"
std::string unknown_lens_model(std::string_view name);

/// The fault of a list of `found` numbers, the first `before` of which are not numbers of
/// distortion: "found 3 numbers, OPENCV has 4". Nothing if the model has lists of this length.
std::optional<std::string> distortion_count_fault(const LensModelEntry& model, std::size_t found,
                                                  std::size_t before = 0);

/// The model of this name.
/// Fails    UsageError: unknown_lens_model().
const LensModelEntry& lens_model_of(std::string_view name);

/// The lens of a model with its numbers of distortion in order.
/// Fails    UsageError for another count of numbers, and as find_fault().
Lens lens_of_numbers(const LensModelEntry& model, std::span<const double> distortion,
                     double max_radius = std::numeric_limits<double>::infinity());

/// Of the model of a name, as lens_model_of().
Lens lens_of_numbers(std::string_view model, std::span<const double> distortion,
                     double max_radius = std::numeric_limits<double>::infinity());

}  // namespace fathom
