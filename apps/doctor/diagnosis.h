#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/doctor/data_set.h"
#include "apps/doctor/hypothesis.h"
#include "apps/doctor/noise.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

/// The search for the hypothesis that explains a data set.
namespace fathom::doctor {

/// Residuals before a fault is corrected, all others being corrected, and after.
struct Evidence {
  Agreement before, after;
};

/// A fault with its evidence.
struct FoundFault {
  std::string name, text;
  Evidence evidence;
  /// Texts of other explanations that fit as well.
  std::vector<std::string> alternatives = {};
};

enum class Verdict : std::uint8_t {
  well,     ///< no fault is found, and the mesh explains the images
  faulty,   ///< faults are found
  unclear,  ///< two explanations fit equally well
  unknown   ///< no known fault explains the images
};
std::string name_of(Verdict verdict);

struct Diagnosis {
  Verdict verdict = Verdict::well;
  Hypothesis hypothesis;
  std::vector<FoundFault> faults;
  /// A stored depth that stands for no value or for depths beyond it.
  std::optional<double> no_value;
  /// Conventions that are not faults.
  std::vector<std::string> notes;
  /// Residuals as given, and after all corrections.
  Agreement given, corrected;
  /// What remains after all corrections, and whether the images are explained except for noise of
  /// more than the tolerance of the search.
  Noise noise;
  bool is_noisy = false;
  /// The tolerance of all shares, as a part of the depth.
  double tolerance = 0;
  /// Images that were looked at.
  std::size_t images = 0;
};

/// Looks for the faults of a data set: first for a coarse one, or two together, that explain images
/// that the cameras as given do not; then, one after the other, for small ones.
/// `progress` is called with the share done.
Diagnosis diagnose(DataSet& data, const std::function<void(double)>& progress);

/// The camera of a view without the faults that were found.
Camera corrected_camera(const View& view, const Diagnosis& found);

/// The depth image of a view without the faults that were found: Z in scene units, binary32, +∞
/// where there is no value.
DepthMap corrected_map(const View& view, const Diagnosis& found);

/// The diagnosis for people. `cure` is the command that writes corrected files, shown if the faults
/// are certain; may be empty.
std::string to_text(const Diagnosis& found, const std::string& cure);
/// The same as JSON.
std::string to_json(const Diagnosis& found, const std::string& cure);

}  // namespace fathom::doctor
