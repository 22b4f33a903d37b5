#include "fathom/camera/lens_numbers.h"

#include <algorithm>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom {

std::string unknown_lens_model(std::string_view name) {
  std::vector<std::string> names;
  for (const LensModelEntry& entry : lens_models()) names.emplace_back(entry.name);
  return "unknown lens model '" + std::string(name) + "', expected " + joined(names, " or ") +
         suggestion(name, names);
}

std::optional<std::string> distortion_count_fault(const LensModelEntry& model, std::size_t found,
                                                  std::size_t before) {
  std::vector<std::size_t> counts(model.shorter_lists.begin(), model.shorter_lists.end());
  counts.push_back(model.distortion.size());
  std::vector<std::string> expected;
  for (const std::size_t count : counts) {
    if (found == before + count) return std::nullopt;
    expected.push_back(std::to_string(before + count));
  }
  return "found " + text::counted(found, "number") + ", " + std::string(model.name) + " has " +
         joined(expected, " or ");
}

const LensModelEntry& lens_model_of(std::string_view name) {
  const auto found = lens_model_named(name);
  if (!found) throw UsageError(unknown_lens_model(name));
  return entry_of(*found);
}

Lens lens_of_numbers(const LensModelEntry& model, std::span<const double> distortion,
                     double max_radius) {
  const StandardArithmetic standard;
  if (const auto fault = distortion_count_fault(model, distortion.size())) {
    const std::vector<std::string> names(model.distortion.begin(), model.distortion.end());
    throw UsageError(*fault + ": " + joined(names, ", "));
  }
  Lens lens{model.model};
  std::ranges::copy(distortion, lens.distortion.begin());
  lens.max_radius = max_radius;
  if (const auto fault = find_fault(lens)) throw UsageError(*fault);
  return lens;
}

Lens lens_of_numbers(std::string_view model, std::span<const double> distortion,
                     double max_radius) {
  const StandardArithmetic standard;
  return lens_of_numbers(lens_model_of(model), distortion, max_radius);
}

}  // namespace fathom
