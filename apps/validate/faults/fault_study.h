#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/validate/faults/fault.h"
#include "apps/validate/faults/golden_image.h"
#include "fathom/attribution/attribution.h"
#include "validation/drawn_map.h"

/// How large a fault has to be to be found and rightly named.
namespace fathom::validation {

/// A right map with the data for measuring and judging its changed versions.
struct FaultSubject {
  const ValidationScene& scene;
  attribution::Truth truth;
  attribution::OtherMap map;
  attribution::RendererModel model;
  attribution::Attribution found;  ///< of the right map
};

/// The map of a renderer without rounding.
attribution::OtherMap exact_map_of(const ValidationScene& scene);

/// A renderer's map as a user supplies it: only depths, in binary32.
attribution::OtherMap as_brought(const attribution::OtherMap& drawn);

/// `model`: the named model of the renderer.
FaultSubject fault_subject(const ValidationScene& scene, const attribution::OtherMap& drawn,
                           const attribution::RendererModel& model);

/// Median change of depth over the changed pixels, in half widths of the model's intervals;
/// infinite if surfaces appeared or disappeared in half of these pixels.
double effect_of(const FaultSubject& subject, const attribution::OtherMap& map);

/// Sizes of a fault whose effects are about 1, 3, 10 and 100, measured on exact maps instead of the
/// renderer's. A fault without a size has the size 0.
std::vector<double> sizes_of(const Fault& fault, const FaultSubject& subject);

/// A map that went wrong.
attribution::OtherMap changed_map(const Fault& fault, const FaultSubject& subject, double size);

/// Verdict on a fault of one size.
struct FaultResult {
  double size = 0, effect = 0;
  bool is_found = false;  ///< a pixel is unexplained, or there is a finding or note
  bool is_named = false;  ///< and the first name is right
  std::string said;       ///< kind and text
  GoldenVerdicts golden;  ///< verdict of comparing pictures
};

FaultResult judged(const Fault& fault, const FaultSubject& subject,
                   const attribution::OtherMap& map, double size);

// Verdicts on the catalogue's faults, as tables.

/// A fault of one size in one renderer's map of one scene.
struct FaultCase {
  const Fault* fault = nullptr;
  std::string scene, renderer;
  /// Reason for a missing map, in one line; empty if the map exists.
  std::string failure;
  FaultResult result;
};

/// A right map and its findings, which should be empty.
struct RightCase {
  std::string scene, renderer, failure, said;
};

struct FaultStudy {
  std::vector<RightCase> right;
  std::vector<FaultCase> faults;

  /// Nothing is found in right maps, and all faults are found and rightly named whose effect is
  /// three times the model's bound or more.
  [[nodiscard]] bool is_good() const;
};

/// Least effect with which a fault must be found and rightly named, in half widths of the model's
/// intervals.
inline constexpr double effect_to_be_named = 3;

/// A line for each right map with a finding and for each fault that is not rightly named.
std::string lines_of(const FaultStudy& study);
/// A row for each fault, a column for each renderer: the least effect from which on it is always
/// found and rightly named; and what comparing pictures sees of it.
std::string to_markdown(const FaultStudy& study);
std::string to_json(const FaultStudy& study);

}  // namespace fathom::validation
