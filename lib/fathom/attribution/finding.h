#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fathom::attribution {

/// A quantity that was estimated from a map.
struct Estimate {
  std::string name;
  double value = 0;
  /// Standard deviation, from residuals that are summed corner by corner of the mesh: triangles
  /// that share one share its roundings.
  double deviation = 0;
  /// "pixels", "scene units", "rad" or empty.
  std::string unit;
};

/// What was found out about the whole image, a triangle or some pixels: mostly that it is wrong.
struct Finding {
  /// See docs/validation.md, "Findings".
  std::string kind;
  /// The finding as a clause.
  std::string text;
  /// How many it explains.
  std::uint64_t pixels = 0;
  std::vector<Estimate> estimates = {};
  /// Kinds of alternatives that explain the map equally well with as many parameters.
  std::vector<std::string> alternatives = {};
  /// The evidence, one clause per line of the report.
  std::vector<std::string> evidence = {};
};

}  // namespace fathom::attribution
