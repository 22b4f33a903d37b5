#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fathom::app {

/// Directions or points from a CSV file, and the other columns of each.
struct LightList {
  enum class Kind { directions, points };

  /// For messages.
  std::string file;
  /// The headings of the other columns, in their order; no heading occurs twice.
  std::vector<std::string> headings;
  struct Light {
    std::array<double, 3> numbers{};
    /// The text of the other columns, as it is in the file.
    std::vector<std::string> fields;
    std::uint64_t line = 0;
  };
  std::vector<Light> lights;
};

/// Reads a CSV file with a heading that has the columns x, y and z, in any order, or, for
/// directions without these, azimuth and elevation (fathom/camera/sun_position.h), which are other
/// columns too. Each number is rounded once to binary64. No field contains a line break.
/// Fails    InputError "FILE: line N: …": a missing column, a column that is there twice, a line of
///          another length, a number that is not finite, a direction that is 0, an azimuth beyond
///          ±360 or an elevation beyond ±90 degrees, no light.
LightList read_lights(const std::string& file, LightList::Kind kind);

}  // namespace fathom::app
