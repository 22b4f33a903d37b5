#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/camera/camera.h"

namespace fathom::app {

/// The ray of a pixel that a lens bends, or why the pixel has none: a part of the answer of
/// `fathom probe`.
class ProbedRay {
 public:
  /// nullopt if the camera bends no rays.
  static std::optional<ProbedRay> of(const Camera& camera, std::uint32_t column, std::uint32_t row);

  /// Lines that end in a line break.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  std::string_view lens_;
  /// Decimals of the direction, whose greatest component is 1 or −1, and the angle to the z axis in
  /// degrees; empty, with a reason, where there is no ray.
  std::array<std::string, 3> direction_;
  double degrees_ = 0;
  std::string why_none_;
  /// Q of the specification, section 2; +∞ if the lens folds nowhere.
  double disc_ = 0;
};

}  // namespace fathom::app
