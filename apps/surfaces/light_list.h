#pragma once

#include <array>
#include <string>
#include <vector>

namespace fathom::app {

/// Directions or points from a CSV file, and what else it says of each.
struct LightList {
  /// Of the other columns, in their order.
  std::vector<std::string> headings;
  struct Light {
    std::array<double, 3> numbers{};
    /// The text of the other columns, as it is in the file.
    std::vector<std::string> fields;
  };
  std::vector<Light> lights;
};

/// Reads a CSV file with a heading that has the columns x, y and z, in any order. Each number is
/// rounded once to binary64. No field contains a line break.
/// Fails    InputError "FILE: line N: …": a missing column, a line of another length, a number that
///          is not finite, no light.
LightList read_lights(const std::string& file);

}  // namespace fathom::app
